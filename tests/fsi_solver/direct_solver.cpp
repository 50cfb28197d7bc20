#include "fsi_solver/solution/direct_solver.hpp"

#include <string>

#include "tests/all_ranks.hpp"
#include "tests/la/strip.hpp"

using namespace vocalis;
using namespace vocalis::fsi;

namespace {

bool is_of_type(KSP solver, const char* type) {
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  PetscBool result = PETSC_FALSE;
  base::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(preconditioner), type, &result));
  return result == PETSC_TRUE;
}

/// Which way the factors of a matrix of long pieces went.
std::string name_of_factors(KSP solver) {
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  const char* name = nullptr;
  base::check(PCShellGetName(preconditioner, &name));
  return name;
}

}  // namespace

TEST_CASE("A direct solver shares out what ranks can eliminate, gathers the rest, and follows the matrix") {
  const bool is_alone = base::size(MPI_COMM_WORLD) == 1;
  for (const Reuse reuse : {Reuse::few_solves, Reuse::many_solves}) {
    // Little is shared by long pieces; of short ones nearly all is. Without diagonals small pivots would have to wait.
    for (const auto& [along, has_constraints] : {std::pair(60, false), std::pair(60, true), std::pair(1, false)}) {
      if (has_constraints && reuse == Reuse::many_solves) continue;  // PETSc's factors do not pivot
      la::Strip strip(along, has_constraints);
      const la::PetscLinearSolver solver = create_repeatable_solver(strip.matrix.get(), "test_direct_", reuse);
      const bool is_shell = !is_alone && reuse == Reuse::few_solves;
      if (along == 60) CHECK(is_of_type(solver.get(), PCSHELL) == is_shell);
      for (const double factor : {1.0, 3.0}) {
        strip.fill(factor);
        base::check(KSPSetOperators(solver.get(), strip.matrix.get(), strip.matrix.get()));
        CHECK(strip.residual([&](Vec b, Vec x) { base::check(KSPSolve(solver.get(), b, x)); }) < 1e-13);
        if (along == 60 && is_shell) {
          CHECK(name_of_factors(solver.get()) == (has_constraints ? "gathered factors" : "shared factors"));
        }
      }
    }
  }
}
