#include "fsi_solver/solution/direct_solver.hpp"

#include "core/base/mpi.hpp"
#include "fsi_solver/solution/shared_factors.hpp"

namespace vocalis::fsi {

void make_repeatable_solver(KSP solver, Mat matrix, const std::string& prefix, Reuse reuse) {
  base::check(KSPSetOptionsPrefix(solver, prefix.c_str()));
  base::check(KSPSetType(solver, KSPPREONLY));
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  const int ranks = base::size(PetscObjectComm(reinterpret_cast<PetscObject>(solver)));
  if (ranks == 1 || reuse == Reuse::many_solves || !use_shared_factors(preconditioner, matrix, prefix)) {
    use_gathered_factors(preconditioner, prefix, reuse);
  }
  base::check(KSPSetFromOptions(solver));
}

la::PetscLinearSolver create_repeatable_solver(Mat matrix, const std::string& prefix, Reuse reuse) {
  la::PetscLinearSolver solver;
  base::check(KSPCreate(PetscObjectComm(reinterpret_cast<PetscObject>(matrix)), solver.put()));
  make_repeatable_solver(solver.get(), matrix, prefix, reuse);
  return solver;
}

}  // namespace vocalis::fsi
