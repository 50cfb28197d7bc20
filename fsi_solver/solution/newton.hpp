#pragma once

#include <exception>
#include <string>
#include <vector>

#include "core/base/timers.hpp"
#include "fsi_solver/solution/assembly.hpp"
#include "fsi_solver/solution/secants.hpp"

namespace vocalis::fsi {

/// How a non-linear solve ended.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  int jacobians = 0;    ///< factorised in this solve
  double residual = 0;  ///< see ResidualSize
  bool inverted = false;
  std::string reason;  ///< empty when converged
};

/// PETSc's SNES on an Assembly, options `-flow_...`. The Jacobian is kept from iteration to iteration and from step to
/// step and improved by secants; it is renewed when the residual still falls too slowly, or the stage's coefficients
/// have changed.
class Newton {
 public:
  /// `assembly` must outlive this. Collective.
  Newton(Assembly& assembly, double tolerance, int largest_iterations, base::Timers& timers);
  Newton(const Newton&) = delete;
  Newton& operator=(const Newton&) = delete;

  /// One step from a state; the result stays in the assembly (end_velocity, ...). Collective.
  NewtonReport solve(const State& state, const Stage& stage);
  /// Forgets the kept Jacobian, so that the next step depends on the state alone.
  void drop_jacobian() { has_jacobian_ = false; }

 private:
  NewtonReport attempt(const State& state, const Stage& stage, Start start);
  static PetscErrorCode residual(SNES snes, Vec unknowns, Vec result, void* self);
  static PetscErrorCode jacobian(SNES snes, Vec unknowns, Mat matrix, Mat same, void* self);
  static PetscErrorCode improve(SNESLineSearch search, Vec unknowns, Vec change, PetscBool* changed, void* self);
  static PetscErrorCode test(SNES snes, PetscInt iteration, PetscReal, PetscReal, PetscReal,
                             SNESConvergedReason* reason, void* self);
  Assembly& assembly_;
  base::Timers& timers_;
  double tolerance_;
  la::PetscNonlinearSolver solver_;
  la::PetscVector unknowns_, result_;
  Secants secants_;
  bool has_jacobian_ = false;
  bool has_step_ = true;  ///< the last linear solve of this solve gave one
  Stage jacobian_stage_;
  int jacobians_ = 0;
  std::size_t last_renewal_ = 0;  ///< number of errors that were known when the Jacobian was renewed in this solve
  ResidualSize size_;
  std::vector<double> errors_;  ///< of the iterations of this solve
  std::exception_ptr failure_;
};

}  // namespace vocalis::fsi
