#include "core/la/solve.hpp"

namespace vocalis::la {

PetscLinearSolver create_linear_solver(MPI_Comm comm, const LinearSolverSettings& settings) {
  PetscLinearSolver solver;
  base::check(KSPCreate(comm, solver.put()));
  base::check(KSPSetOptionsPrefix(solver.get(), settings.prefix.c_str()));
  base::check(KSPSetType(solver.get(), settings.method.c_str()));
  // A guess that is far off next to a small right-hand side is no sign of a solver that diverges.
  const PetscReal divergence = settings.start_from_given ? PETSC_MAX_REAL : PETSC_DEFAULT;
  base::check(KSPSetTolerances(solver.get(), settings.relative_tolerance, PETSC_DEFAULT, divergence,
                               settings.largest_iterations));
  base::check(KSPSetInitialGuessNonzero(solver.get(), settings.start_from_given ? PETSC_TRUE : PETSC_FALSE));
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver.get(), &preconditioner));
  base::check(PCSetType(preconditioner, settings.preconditioner.c_str()));
  base::check(KSPSetFromOptions(solver.get()));
  return solver;
}

SolveReport solve(KSP solver, Vec right_hand_side, Vec solution) {
  base::check(KSPSolve(solver, right_hand_side, solution));
  SolveReport report;
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  base::check(KSPGetConvergedReason(solver, &reason));
  PetscInt iterations = 0;
  base::check(KSPGetIterationNumber(solver, &iterations));
  base::check(KSPGetResidualNorm(solver, &report.residual));
  report.iterations = static_cast<int>(iterations);
  report.converged = reason > 0;
  if (!report.converged) report.reason = KSPConvergedReasons[reason];
  return report;
}

}  // namespace vocalis::la
