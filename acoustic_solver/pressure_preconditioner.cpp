#include "acoustic_solver/pressure_preconditioner.hpp"

#include <array>
#include <string>
#include <utility>

namespace vocalis::acoustic {

namespace {

constexpr double kLargestLocalCourantNumber = 3;

// Coarsening and interpolation of few entries (De Sterck, Falgout, Nolting & Yang 2008), aggressive on the finest grid
// along two paths at least; PETSc takes them as options alone.
constexpr std::array<std::pair<const char*, const char*>, 7> kMultigrid = {{{"coarsen_type", "HMIS"},
                                                                            {"interp_type", "ext+i"},
                                                                            {"P_max", "4"},
                                                                            {"agg_nl", "1"},
                                                                            {"agg_num_paths", "2"},
                                                                            {"strong_threshold", "0.25"},
                                                                            {"relax_type_all", "Chebyshev"}}};

void set_multigrid_options() {
  for (const auto& [key, value] : kMultigrid) {
    const std::string name = std::string("-acoustic_pc_hypre_boomeramg_") + key;
    PetscBool given = PETSC_FALSE;
    base::check(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &given));
    if (!given) base::check(PetscOptionsSetValue(nullptr, name.c_str(), value));
  }
}

/// The solver of each rank's block, unless the options say otherwise.
void set_block_preconditioner(KSP solver, Preconditioner choice) {
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  PetscBool is_block = PETSC_FALSE, given = PETSC_FALSE;
  base::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(preconditioner), PCBJACOBI, &is_block));
  base::check(PetscOptionsHasName(nullptr, nullptr, "-acoustic_sub_pc_type", &given));
  if (!is_block || given) return;
  base::check(PCSetUp(preconditioner));
  PetscInt blocks = 0;
  KSP* block_solvers = nullptr;
  base::check(PCBJacobiGetSubKSP(preconditioner, &blocks, nullptr, &block_solvers));
  for (PetscInt i = 0; i < blocks; ++i) {
    PC block = nullptr;
    base::check(KSPGetPC(block_solvers[i], &block));
    base::check(PCSetType(block, choice == Preconditioner::cholesky ? PCCHOLESKY : PCICC));
    if (choice == Preconditioner::incomplete) base::check(PCFactorSetLevels(block, 1));
    // Fewer entries than by nested dissection, and numbers sooner: a moving mesh takes them anew at each sub-step.
    if (choice == Preconditioner::cholesky) base::check(PCFactorSetMatOrderingType(block, MATORDERINGQMD));
  }
}

}  // namespace

Preconditioner choose_preconditioner(int dimension, int ranks, double courant_number) {
  // A plane block is factorised in the time of a few solves, and the factors of an earlier geometry serve for long; in
  // space they cost too much. Blocks do not see each other, which matters where sound crosses many cells in a step.
  const bool is_local = courant_number <= kLargestLocalCourantNumber;
  if (dimension == 2 && (is_local || ranks == 1)) return Preconditioner::cholesky;
  return is_local ? Preconditioner::incomplete : Preconditioner::multigrid;
}

la::PetscLinearSolver create_pressure_solver(Mat product, Mat assembled, Preconditioner preconditioner,
                                             double tolerance) {
  const bool is_multigrid = preconditioner == Preconditioner::multigrid;
  if (is_multigrid) set_multigrid_options();
  MPI_Comm comm = MPI_COMM_NULL;
  base::check(PetscObjectGetComm(reinterpret_cast<PetscObject>(assembled), &comm));
  auto solver = la::create_linear_solver(comm, {.prefix = "acoustic_",
                                                .method = KSPCG,
                                                .preconditioner = is_multigrid ? PCHYPRE : PCBJACOBI,
                                                .relative_tolerance = tolerance,
                                                .largest_iterations = 2000,
                                                .start_from_given = true});
  base::check(KSPSetOperators(solver.get(), product, assembled));
  set_block_preconditioner(solver.get(), preconditioner);
  return solver;
}

}  // namespace vocalis::acoustic
