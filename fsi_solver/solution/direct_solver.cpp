#include "fsi_solver/solution/direct_solver.hpp"

#include "core/base/mpi.hpp"

namespace vocalis::fsi {

namespace {

/// A default in PETSc's table of options: the inner solver of a gathered one is born later and reads only from there.
void set_default_option(const std::string& name, const std::string& value) {
  PetscBool exists = PETSC_FALSE;
  base::check(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &exists));
  if (!exists) base::check(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
}

}  // namespace

void make_gathered_solver(KSP solver, const std::string& prefix, Reuse reuse) {
  MPI_Comm comm = PetscObjectComm(reinterpret_cast<PetscObject>(solver));
  const int ranks = base::size(comm);
  base::check(KSPSetOptionsPrefix(solver, prefix.c_str()));
  base::check(KSPSetType(solver, KSPPREONLY));
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  const char* package = reuse == Reuse::few_solves ? MATSOLVERMUMPS : MATSOLVERPETSC;
  if (ranks > 1) {
    base::check(PCSetType(preconditioner, PCTELESCOPE));
    base::check(PCTelescopeSetReductionFactor(preconditioner, ranks));
    const std::string inner = "-" + prefix + "telescope_";
    set_default_option(inner + "ksp_type", KSPPREONLY);
    set_default_option(inner + "pc_type", PCLU);
    set_default_option(inner + "pc_factor_mat_solver_type", package);
    if (reuse == Reuse::many_solves) set_default_option(inner + "pc_factor_mat_ordering_type", MATORDERINGND);
  } else {
    base::check(PCSetType(preconditioner, PCLU));
    base::check(PCFactorSetMatSolverType(preconditioner, package));
    if (reuse == Reuse::many_solves) base::check(PCFactorSetMatOrderingType(preconditioner, MATORDERINGND));
  }
  // MUMPS foresees too little memory where pivots move (error -9): twice as much.
  if (reuse == Reuse::few_solves) {
    set_default_option("-" + prefix + (ranks > 1 ? "telescope_" : "") + "mat_mumps_icntl_14", "100");
  }
  base::check(KSPSetFromOptions(solver));
}

la::PetscLinearSolver create_gathered_solver(MPI_Comm comm, const std::string& prefix, Reuse reuse) {
  la::PetscLinearSolver solver;
  base::check(KSPCreate(comm, solver.put()));
  make_gathered_solver(solver.get(), prefix, reuse);
  return solver;
}

}  // namespace vocalis::fsi
