#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/microphones.hpp"
#include "coupling/analogies/analogy.hpp"
#include "coupling/case/case.hpp"
#include "coupling/scene.hpp"
#include "transfer/carry.hpp"

namespace vocalis::coupling {

/// One [[acoustic]] of a case: a solver, the analogy that feeds it, and the microphones that listen to it.
class Voice {
 public:
  /// The scene must outlive the voice. Throws UserError for a microphone outside of the air, or a far field that cannot
  /// be. Collective.
  Voice(Scene& scene, const Case& config, const acoustic::AcousticSettings& settings);

  /// Follows one accepted step of the flow. The air moves with the flow mesh: displacements [m] at the step's beginning
  /// and end, P1 on the flow mesh, ghosts current. Collective.
  acoustic::AdvanceReport follow(const FlowView& flow, const fem::Field& displacement_begin,
                                 const fem::Field& displacement_end);

  /// Takes the place that the flow's displacement [m] gives it, after the states were replaced. Collective.
  void move_to(const fem::Field& displacement);

  /// Forgets what is kept for speed and where the microphones were found: what follows depends on the state and the
  /// mesh's place alone. Collective.
  void drop_caches();

  /// Advances by dt [s] with a prescribed flux g(t) [m/s] instead of a flow. Collective.
  acoustic::AdvanceReport drive(double dt, const std::function<double(double)>& flux);

  /// Which integrator the steps of the case get on the mesh as it is now, and why, in words. Collective.
  std::string integrator_words() const;

  acoustic::AcousticSolver& solver() { return solver_; }
  const acoustic::AcousticSolver& solver() const { return solver_; }
  acoustic::Microphones& microphones() { return microphones_; }
  const acoustic::Microphones& microphones() const { return microphones_; }
  /// Whether each microphone hears the flow's pressure, too. Collective.
  std::vector<std::int32_t> in_flow() const { return microphones_.in_flow(cell_has_flow_); }

 private:
  std::vector<double> moved_coordinates(const fem::Field& displacement) const;
  double fade(double time) const;
  /// The flow's pressure at the acoustic mesh's vertices, of its fluid cells [Pa].
  std::vector<double> flow_pressure(const std::vector<double>& of_flow_vertices) const;

  Scene& scene_;
  acoustic::AcousticSettings settings_;
  double step_;  ///< of the case [s]
  bool moves_;   ///< the air, with solids in the flow
  std::unique_ptr<Analogy> analogy_;
  std::vector<std::int32_t> cell_has_flow_;  ///< (owned cells of the acoustic mesh)
  acoustic::AcousticSolver solver_;
  acoustic::Microphones microphones_;
  std::vector<double> rest_coordinates_;
  std::unique_ptr<transfer::SharedVertices> flow_to_acoustic_;
};

}  // namespace vocalis::coupling
