#pragma once

#include <string>

#include "core/la/petsc.hpp"

namespace vocalis::la {

/// How a linear or non-linear solve ended. Never printed here: the caller decides.
struct SolveReport {
  bool converged = false;
  int iterations = 0;
  double residual = 0;  ///< norm of the last residual, in the solver's own scale
  std::string reason;   ///< empty when converged
};

/// What a linear solver is before the user's options `-PREFIX_ksp_...`, `-PREFIX_pc_...` change it.
struct LinearSolverSettings {
  std::string prefix;  ///< of PETSc's options, with its underscore
  std::string method = KSPCG;
  std::string preconditioner = PCJACOBI;
  double relative_tolerance = 1e-10;
  int largest_iterations = 1000;
  bool start_from_given = true;  ///< the solution vector is the starting guess
};

/// A Krylov solver. Collective.
PetscLinearSolver create_linear_solver(MPI_Comm comm, const LinearSolverSettings& settings);

/// Solves A x = b with the operators set in the solver. Collective.
SolveReport solve(KSP solver, Vec right_hand_side, Vec solution);

}  // namespace vocalis::la
