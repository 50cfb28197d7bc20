#include "fsi_solver/solution/shared_factors.hpp"

#include <memory>

#include "core/la/separator.hpp"
#include "core/la/substructuring.hpp"
#include "fsi_solver/solution/gathered_factors.hpp"

namespace vocalis::fsi {

namespace {

using Preconditioner = la::Owner<PC, PCDestroy>;

struct Factors {
  Factors(Mat matrix, const std::string& prefix) : prefix(prefix), shared(matrix, la::find_separator(matrix)) {}
  std::string prefix;
  la::Substructuring shared;
  bool is_shared = false;
  Preconditioner gathered;  ///< none before it is needed
};

Factors& factors_of(PC preconditioner) {
  Factors* factors = nullptr;
  base::check(PCShellGetContext(preconditioner, &factors));
  return *factors;
}

PetscErrorCode set_up(PC preconditioner) {
  Factors& factors = factors_of(preconditioner);
  factors.is_shared = factors.shared.factorise();
  // What -ksp_view prints.
  PetscCall(PCShellSetName(preconditioner, factors.is_shared ? "shared factors" : "gathered factors"));
  if (factors.is_shared) return 0;
  Mat matrix = nullptr;
  PetscCall(PCGetOperators(preconditioner, nullptr, &matrix));
  if (!factors.gathered) {
    PetscCall(PCCreate(PetscObjectComm(reinterpret_cast<PetscObject>(preconditioner)), factors.gathered.put()));
    PetscCall(PCSetOptionsPrefix(factors.gathered.get(), (factors.prefix + "gathered_").c_str()));
    use_gathered_factors(factors.gathered.get(), factors.prefix + "gathered_", Reuse::few_solves);
    PetscCall(PCSetFromOptions(factors.gathered.get()));
  }
  PetscCall(PCSetOperators(factors.gathered.get(), matrix, matrix));
  return PCSetUp(factors.gathered.get());
}

PetscErrorCode apply(PC preconditioner, Vec right_hand_side, Vec solution) {
  Factors& factors = factors_of(preconditioner);
  if (!factors.is_shared) return PCApply(factors.gathered.get(), right_hand_side, solution);
  factors.shared.solve(right_hand_side, solution);
  return 0;
}

PetscErrorCode destroy(PC preconditioner) {
  delete &factors_of(preconditioner);
  return 0;
}

}  // namespace

bool use_shared_factors(PC preconditioner, Mat matrix, const std::string& prefix) {
  auto factors = std::make_unique<Factors>(matrix, prefix);
  if (factors->shared.dense_share() > 1) return false;
  base::check(PCSetType(preconditioner, PCSHELL));
  base::check(PCShellSetContext(preconditioner, factors.release()));
  base::check(PCShellSetSetUp(preconditioner, set_up));
  base::check(PCShellSetApply(preconditioner, apply));
  base::check(PCShellSetDestroy(preconditioner, destroy));
  return true;
}

}  // namespace vocalis::fsi
