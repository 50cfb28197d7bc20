#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/integrator_choice.hpp"
#include "acoustic_solver/settings.hpp"
#include "acoustic_solver/state.hpp"
#include "core/fem/field.hpp"
#include "core/fem/space.hpp"
#include "transfer/strip.hpp"

namespace vocalis::acoustic {

/// How the vertices move during one `advance`: linearly in time, from begin to end. Both empty: the mesh stands still
/// at its own coordinates. (vertices, dimension) [m], ghosts current. And how the medium flows through it.
struct Motion {
  std::span<const double> begin = {}, end = {};
  std::span<const double> convection = {};  ///< U (vertices, dimension) [m/s], ghosts current; empty: at rest
};

/// The right-hand side (Q, q) + <g, q>.
struct Source {
  const fem::Load* begin = nullptr;    ///< at the beginning of the advance, summed to the owners [m^3/s;
  const fem::Load* end = nullptr;      ///< m^2/s in two dimensions]; linear in between. Both or none.
  std::function<double(double)> flux;  ///< g(t) [m/s] into the air through the boundaries of kind `flux`
  /// (vertices) p [Pa] during the advance where boundaries release it; empty: 0
  std::span<const double> released = {};
};

/// What going on with another mesh did to the energy, see `AcousticSolver::energy`.
struct Adoption {
  double energy_before = 0, energy_after = 0;  ///< [J; J/m in two dimensions]
};

/// Sound on a mesh that may move: pressure p and velocity potential ψ (u = -∇ψ), both P1,
///
///   (1 / (ρ c²)) (ṗ - v·∇p, q) + (∇ψ, ∇q) + <u·n, q> = (Q, q) + <g, q>,     ψ̇ - v·∇ψ = p / ρ at each vertex,
///
/// where the rates are at a fixed vertex, which moves with β, and v = β - U with the velocity U of the medium. Time: an
/// implicit or an explicit integrator, with a geometry from within the sub-step. Equations, boundary conditions and
/// accuracy: docs/theory.md.
class AcousticSolver {
 public:
  /// Silence on `mesh`, which must outlive the solver or be replaced by `adopt`. PETSc's options begin with
  /// "acoustic_". Throws UserError if a setting is out of its range or names an unknown group. Collective.
  AcousticSolver(const mesh::Mesh& mesh, const AcousticSettings& settings);
  /// Silence beside another sound on the same mesh, with the same settings but for name and analogy: both share what
  /// follows from these, matrices and preconditioners for the most part, which are made once if both take the same
  /// steps one after the other with the same motion. `adopt` ends that.
  static AcousticSolver beside(const AcousticSolver& other, const AcousticSettings& settings);
  ~AcousticSolver();
  AcousticSolver(AcousticSolver&&) noexcept;
  AcousticSolver& operator=(AcousticSolver&&) noexcept;

  /// Advances by dt [s] > 0 in equal sub-steps no longer than `settings.step`, and calls on_substep(time) after each;
  /// the explicit integrator divides them further where it must. Collective.
  AdvanceReport advance(double dt, const Motion& motion = {}, const Source& source = {},
                        const std::function<void(double)>& on_substep = {});

  /// The integrator for advancing by dt [s] from the present geometry, if the mesh then moves or stands still, and the
  /// medium flows or is at rest. The choice is made anew at each `advance`. Collective.
  IntegratorChoice choice(double dt, bool moves, bool flows = false) const;

  const State& state() const { return state_; }
  /// Goes on from another state of the same mesh, a checkpoint's; forgets what `drop_caches` forgets.
  void set_state(State state);
  /// Forgets matrices and preconditioner: what follows depends on the state alone, to the last bit.
  void drop_caches();
  /// Goes on with another strip of the same parent, each mesh at its present coordinates. All that cells of both
  /// and their vertices have is carried to the last bit, histories of layers and walls too. What has opened begins with
  /// the mean of its neighbours' p, walls there at rest, and the velocity of least energy (`join_pockets`). `after`
  /// must outlive the solver; integrators are made anew. Throws UserError if a cell of an absorbing layer is gone.
  /// Collective.
  Adoption adopt(const mesh::Mesh& parent, const transfer::StrippedMesh& before, const transfer::StrippedMesh& after);

  const AcousticSettings& settings() const { return settings_; }
  const fem::Space& space() const;
  fem::Field pressure() const;
  /// Acoustic energy ∫ ½ p²/(ρ c²) + ½ ρ |u|², and that of walls that yield [J; J/m in two dimensions]. Collective.
  double energy() const;

 private:
  struct Discretisation;
  AcousticSolver(const AcousticSettings& settings, std::shared_ptr<Discretisation> discretisation);
  /// Sets the velocities, and where the mesh stands still the geometry; returns whether it moves.
  bool place(double dt, const Motion& motion);
  /// Sets p of released vertices to what the flow or the source makes it, or 0.
  void settle_released(std::span<const double> values);
  /// The explicit integrator's [s], on the way of the motion.
  double stable_step(bool moves, const std::function<void(double)>& place_at);

  AcousticSettings settings_;
  std::shared_ptr<Discretisation> discretisation_;  ///< derived from the mesh and the settings
  State state_;
};

}  // namespace vocalis::acoustic
