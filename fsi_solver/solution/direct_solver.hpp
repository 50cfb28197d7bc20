#pragma once

#include <string>

#include "core/la/petsc.hpp"

namespace vocalis::fsi {

/// How often a factorisation is used: MUMPS factors fast, PETSc's own factors (nested dissection) solve fast.
enum class Reuse { few_solves, many_solves };

/// A direct solver that gathers the system on one rank and factors it there, so that its answer is the same bit by bit
/// in every run on the same ranks (MUMPS on several ranks sums in the order in which messages arrive). For systems of
/// plane problems, where one processor is as fast as two. The user's options `-PREFIX_...` win.
/// Collective.
la::PetscLinearSolver create_gathered_solver(MPI_Comm comm, const std::string& prefix, Reuse reuse);

/// Gives a solver that exists already (SNES's own) the same set-up. Collective.
void make_gathered_solver(KSP solver, const std::string& prefix, Reuse reuse);

}  // namespace vocalis::fsi
