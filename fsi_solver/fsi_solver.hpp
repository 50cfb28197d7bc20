#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/timers.hpp"
#include "fsi_solver/settings.hpp"
#include "fsi_solver/state.hpp"

namespace vocalis::fsi {

struct Continuum;
class Assembly;

/// How a step ended. Nothing is printed here: the caller decides.
struct StepReport {
  bool converged = false;
  int newton_iterations = 0;
  int linear_iterations = 0;    ///< direct solves, one a Newton iteration
  int jacobians = 0;            ///< factorised in this step
  double local_error = 0;       ///< relative estimate, see `local_error`; only when the step is to adapt
  double residual = 0;          ///< largest over fields and regions, relative to the size of their terms
  std::string reason;           ///< empty when converged
  double smallest_quality = 1;  ///< of the moved fluid mesh at the end of the step, see mesh::quality
  bool inverted = false;        ///< a cell would have turned over
};

/// The unified continuum: incompressible flow on a moving mesh and elastic solids in it, solved together for one
/// velocity and one pressure. Equations in docs/theory.md. What the mesh does not have costs nothing: without solids
/// the mesh stands still, without fluid there is no pressure but that of incompressible solids.
class FsiSolver {
 public:
  /// mesh  the flow mesh, which is the reference configuration; a region that no solid names is fluid. Must outlive
  /// this. Starts from rest at time 0. Collective. Throws UserError for settings that do not fit the mesh.
  FsiSolver(const mesh::Mesh& mesh, const FlowSettings& flow, const TimeSettings& time, Prescribed prescribed = {});
  ~FsiSolver();
  FsiSolver(const FsiSolver&) = delete;
  FsiSolver& operator=(const FsiSolver&) = delete;

  /// Computes t + dt and leaves the accepted state alone. A step that does not converge, or turns a cell over, can only
  /// be tried again, with a smaller dt. Collective.
  StepReport try_step(double dt);
  /// Makes the last step, which must have converged, the accepted state. Collective.
  void accept();

  /// Makes these owned fluid cells contact cells, from the accepted state on, and lets go of all others. Needs
  /// FlowSettings::contact. The mesh stays where it is: where it is no longer held it comes back within
  /// `mesh_recovery`. Where cells close velocities jump: the next step begins anew, with backward Euler where the
  /// scheme is BDF2, whose memory would carry the jump on. Returns the kinetic energy that the air in them loses, see
  /// `capture`. Collective.
  ///
  /// normals  (owned cells, dimension) of the plane of contact, of unit length; only those of cells that were not in
  ///          contact count, and with full friction none does
  double set_contact(std::span<const char> in_contact, std::span<const double> normals = {});

  const State& state() const;
  double time() const { return state().time; }
  /// Replaces the state, for a resumed run or initial conditions. Ghosts must be current.
  void set_state(const State& state);
  /// Forgets everything that is kept for speed, so that the next step depends on the state alone.
  void drop_caches();

  const Continuum& continuum() const;
  const FlowSettings& settings() const;
  /// The last step's equations, for what is measured from them.
  const Assembly& assembly() const;
  /// P1 or P2, without jumps.
  const fem::Space& velocity_space() const;
  /// P1, one label in the fluid (0) and one in each incompressible solid i (1 + i).
  const fem::Space& pressure_space() const;

  /// Velocities and pressures of a step, over all ranks.
  std::int64_t num_unknowns() const;

  /// Where the vertices are, (vertices, dimension) [m]; ghosts current.
  std::vector<double> current_coordinates() const;
  /// Where the last step, which must have converged, takes them.
  std::vector<double> tried_coordinates() const;
  /// Parts of the state at the vertices, on a space of degree 1 whose dofs they are; ghosts current.
  fem::Field velocity_at_vertices() const;
  fem::Field displacement_at_vertices() const;
  /// The fluid's pressure [Pa] at the vertices; 0 where there is no fluid. Collective.
  fem::Field fluid_pressure() const;

  /// Wall seconds of "mesh_motion", "flow.assemble" (which holds it), "flow.newton" (all of the step).
  const base::Timers& timers() const;

 private:
  struct Inside;
  std::unique_ptr<Inside> inside_;
};

/// Smallest quality of the moved fluid mesh. Collective.
double smallest_quality(const FsiSolver& solver);

}  // namespace vocalis::fsi
