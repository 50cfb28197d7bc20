#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/microphones.hpp"
#include "core/base/timers.hpp"
#include "coupling/analogies/analogy.hpp"
#include "coupling/case/case.hpp"
#include "coupling/flow/flow_history.hpp"
#include "coupling/scene.hpp"
#include "coupling/voice/air.hpp"

namespace vocalis::coupling {

/// How often the air of a voice was stripped anew, and the acoustic energy that was lost thereby [J; J/m in two
/// dimensions]; negative where opened air had more than closed air lost.
struct Rebuilds {
  long count = 0;
  double energy_lost = 0;
};

/// One [[acoustic]] of a case: a solver, the analogy that feeds it, and the microphones that listen to it.
class Voice {
 public:
  /// The scene must outlive the voice. Throws UserError for a microphone outside of the air, a far field that cannot
  /// be, or an analogy that cannot do what the settings ask for. Collective.
  ///
  /// beside  a voice on the same mesh to share matrices with where that can be, see `AcousticSolver::beside`
  Voice(Scene& scene, const Case& config, const acoustic::AcousticSettings& settings, const Voice* beside = nullptr);

  /// Follows one accepted step of the flow, and its cells in contact. Collective.
  acoustic::AdvanceReport follow(const FlowStep& step);

  /// Follows one accepted step of the flow in the air as it is. The air moves with the flow mesh: displacements [m] at
  /// the step's beginning and end, P1 on the flow mesh, ghosts current. Collective.
  acoustic::AdvanceReport follow(const FlowView& flow, const fem::Field& displacement_begin,
                                 const fem::Field& displacement_end);

  /// Goes on in the air without the cells in contact, if that is another one and the settings strip them: the air is
  /// stripped from the parent, and state, far fields and microphones go with it. A microphone in cells that are gone
  /// hears nothing. Throws UserError if a layer would lose cells. Collective.
  ///
  /// in_contact    (owned cells of the flow mesh); empty: none
  /// displacement  of the flow [m], now
  void follow_contact(std::span<const char> in_contact, const fem::Field& displacement);

  /// Takes the place that the flow's displacement [m] gives it, after the states were replaced. Collective.
  void move_to(const fem::Field& displacement);

  /// Forgets what is kept for speed and where the microphones were found: what follows depends on the state and the
  /// mesh's place alone. Collective.
  void drop_caches();

  /// Advances by dt [s] with a prescribed flux g(t) [m/s] instead of a flow. Collective.
  acoustic::AdvanceReport drive(double dt, const std::function<double(double)>& flux);

  const Rebuilds& rebuilds() const { return rebuilds_; }
  void set_rebuilds(const Rebuilds& rebuilds) { rebuilds_ = rebuilds; }
  /// The mesh that the sound is on now; another one after `follow_contact`.
  const mesh::Mesh& mesh() const { return air_->mesh(); }
  /// (vertices, dimension) of that mesh [m], where nothing has moved.
  const std::vector<double>& rest_coordinates() const { return air_->rest_coordinates; }
  /// P1 fields of its mesh on the parent's vertices, at rest; `otherwise` where there is no air. Collective.
  void carry_to_parent(const fem::Field& from, fem::Field& to, double otherwise) const;
  /// How the flow fits into a mesh of its own; none on the case's mesh, or without a flow.
  const transfer::PointsOutside* flow_outside() const { return air_->bridge ? &air_->bridge->outside() : nullptr; }
  bool has_own_mesh() const { return air_->is_separate; }

  /// Which integrator the steps of the case get on the mesh as it is now, and why, in words. Collective.
  std::string integrator_words() const;

  /// p_a [Pa] where the last step has led to, P1 on the air; with an analogy for the total pressure what p_ic leaves.
  fem::Field pressure() const;
  Analogy& analogy() { return *analogy_; }
  const Analogy& analogy() const { return *analogy_; }
  /// Which rates of the flow's pressure its analogy wants, and by how many steps it lags.
  acoustic::PressureDerivative derivative() const { return settings_.analogy.pressure_derivative; }
  /// Wall seconds of "analogy", "transfer" and "acoustic".
  const base::Timers& timers() const { return timers_; }

  acoustic::AcousticSolver& solver() { return solver_; }
  const acoustic::AcousticSolver& solver() const { return solver_; }
  acoustic::Microphones& microphones() { return microphones_; }
  const acoustic::Microphones& microphones() const { return microphones_; }
  /// Whether each microphone hears the flow's pressure, too. Collective.
  std::vector<std::int32_t> in_flow() const { return microphones_.in_flow(air_->cell_has_flow); }

 private:
  /// What a flow's step is to the air.
  struct Drive {
    fem::Load begin, end;
    std::vector<double> from, to;              ///< coordinates of the air's vertices [m]
    std::vector<double> released;              ///< (vertices) ∂t p of the flow [Pa/s], where p is what the flow's is
    std::vector<double> convection;            ///< (vertices, d) U [m/s]; empty: none
    std::vector<double> flow_begin, flow_end;  ///< (vertices) p_ic [Pa]
    std::vector<double> head_begin, head_end;  ///< (vertices) what is no pressure in the unknown [Pa]; empty: nothing
  };
  Drive carry(const FlowView& flow, const fem::Field& displacement_begin, const fem::Field& displacement_end);
  double fade(double time) const;
  /// p_a at a part of the step, and p_ic there.
  void split(const Drive& drive, double part);

  Scene& scene_;
  acoustic::AcousticSettings settings_;
  double step_;  ///< of the case [s]
  bool moves_;   ///< the air, with solids in the flow
  std::unique_ptr<Analogy> analogy_;
  std::shared_ptr<Air> air_;    ///< one of its own is shared with the voices that share matrices
  std::vector<char> stripped_;  ///< (owned cells of the flow mesh) no part of the air; empty: none yet
  Rebuilds rebuilds_;
  acoustic::AcousticSolver solver_;
  acoustic::Microphones microphones_;
  std::vector<double> sound_, flow_;  ///< (vertices) p_a and p_ic of the last sub-step [Pa]; empty: p_a is the solver's
  base::Timers timers_;
};

}  // namespace vocalis::coupling
