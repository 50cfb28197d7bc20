#pragma once

#include <string>

#include "fsi_solver/solution/gathered_factors.hpp"

namespace vocalis::fsi {

/// A direct solver whose answer is the same bit by bit in every run on the same ranks (MUMPS on several ranks sums in
/// the order in which messages arrive). Ranks share the factors where few solves use them and that is cheaper, else the
/// first holds them. The user's options `-PREFIX_...` win.
///
/// matrix  whose values may still change, not its structure; must outlive the solver
/// Collective.
la::PetscLinearSolver create_repeatable_solver(Mat matrix, const std::string& prefix, Reuse reuse);

/// Gives a solver that exists already (SNES's own) the same set-up. Collective.
void make_repeatable_solver(KSP solver, Mat matrix, const std::string& prefix, Reuse reuse);

}  // namespace vocalis::fsi
