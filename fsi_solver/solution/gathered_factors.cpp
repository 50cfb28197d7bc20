#include "fsi_solver/solution/gathered_factors.hpp"

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

void use_gathered_factors(PC preconditioner, const std::string& prefix, Reuse reuse) {
  const int ranks = base::size(PetscObjectComm(reinterpret_cast<PetscObject>(preconditioner)));
  const char* package = reuse == Reuse::few_solves ? MATSOLVERMUMPS : MATSOLVERPETSC;
  std::string factors = "-" + prefix;
  if (ranks > 1) {
    base::check(PCSetType(preconditioner, PCTELESCOPE));
    base::check(PCTelescopeSetReductionFactor(preconditioner, ranks));
    factors += "telescope_";
    set_default_option(factors + "ksp_type", KSPPREONLY);
    set_default_option(factors + "pc_type", PCLU);
    set_default_option(factors + "pc_factor_mat_solver_type", package);
    if (reuse == Reuse::many_solves) set_default_option(factors + "pc_factor_mat_ordering_type", MATORDERINGND);
  } else {
    base::check(PCSetType(preconditioner, PCLU));
    base::check(PCFactorSetMatSolverType(preconditioner, package));
    if (reuse == Reuse::many_solves) base::check(PCFactorSetMatOrderingType(preconditioner, MATORDERINGND));
  }
  // MUMPS foresees too little memory where pivots move (error -9): twice as much.
  if (reuse == Reuse::few_solves) set_default_option(factors + "mat_mumps_icntl_14", "100");
}

}  // namespace vocalis::fsi
