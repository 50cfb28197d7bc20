#pragma once

#include <cstdint>

#include "core/la/solve.hpp"

namespace vocalis::acoustic {

/// What conjugate gradients for the pressure are preconditioned with. Measured: docs/validation.md, "Preconditioners of
/// sound".
enum class Preconditioner {
  cholesky,           ///< of each rank's block
  cholesky_of_whole,  ///< of the whole system, which every rank holds and solves
  incomplete,         ///< Cholesky with one level of fill, of each rank's block
  multigrid           ///< BoomerAMG with Chebyshev smoothing
};

/// courant_number  c dt / h of the smallest cell: how far the system couples cells
/// num_unknowns    of all ranks
Preconditioner choose_preconditioner(int dimension, int ranks, double courant_number, std::int64_t num_unknowns);

/// PETSc's options with the prefix "acoustic_" come first. Collective.
la::PetscLinearSolver create_pressure_solver(Mat product, Mat assembled, Preconditioner preconditioner,
                                             double tolerance);

}  // namespace vocalis::acoustic
