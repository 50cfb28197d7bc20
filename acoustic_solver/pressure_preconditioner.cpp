#include "acoustic_solver/pressure_preconditioner.hpp"

#include <array>
#include <string>
#include <utility>

namespace vocalis::acoustic {

namespace {

constexpr double kLargestLocalCourantNumber = 3;
constexpr std::int64_t kLargestWhole = 50000;  ///< unknowns of a plane system that every rank solves whole

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

bool says_options(const char* name) {
  PetscBool given = PETSC_FALSE;
  base::check(PetscOptionsHasName(nullptr, nullptr, name, &given));
  return given == PETSC_TRUE;
}

bool is_of_type(PC preconditioner, const char* type) {
  PetscBool is = PETSC_FALSE;
  base::check(PetscObjectTypeCompare(reinterpret_cast<PetscObject>(preconditioner), type, &is));
  return is == PETSC_TRUE;
}

void factorise(KSP solver, Preconditioner choice) {
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  base::check(PCSetType(preconditioner, choice == Preconditioner::incomplete ? PCICC : PCCHOLESKY));
  if (choice == Preconditioner::incomplete) {
    base::check(PCFactorSetLevels(preconditioner, 1));
  } else {
    // Fewer entries than by nested dissection, and numbers sooner: a moving mesh takes them anew at each sub-step.
    base::check(PCFactorSetMatOrderingType(preconditioner, MATORDERINGQMD));
  }
}

/// The solver of each rank's block or of the whole, unless the options say otherwise.
void set_inner_solvers(KSP solver, Preconditioner choice) {
  PC preconditioner = nullptr;
  base::check(KSPGetPC(solver, &preconditioner));
  if (is_of_type(preconditioner, PCBJACOBI) && !says_options("-acoustic_sub_pc_type")) {
    base::check(PCSetUp(preconditioner));
    PetscInt blocks = 0;
    KSP* block_solvers = nullptr;
    base::check(PCBJacobiGetSubKSP(preconditioner, &blocks, nullptr, &block_solvers));
    for (PetscInt i = 0; i < blocks; ++i) factorise(block_solvers[i], choice);
  }
  if (is_of_type(preconditioner, PCREDUNDANT) && !says_options("-acoustic_redundant_pc_type")) {
    KSP whole = nullptr;
    base::check(PCRedundantGetKSP(preconditioner, &whole));
    factorise(whole, choice);
  }
}

const char* type_of(Preconditioner choice) {
  if (choice == Preconditioner::multigrid) return PCHYPRE;
  return choice == Preconditioner::cholesky_of_whole ? PCREDUNDANT : PCBJACOBI;
}

}  // namespace

Preconditioner choose_preconditioner(int dimension, int ranks, double courant_number, std::int64_t num_unknowns) {
  // A plane block is factorised in the time of a few solves, and the factors of an earlier geometry serve for long; in
  // space they cost too much. Blocks do not see each other, which matters where sound crosses many cells in a step: a
  // small system is then sooner solved whole on every rank, with one gather, than by the messages of multigrid.
  const bool is_local = courant_number <= kLargestLocalCourantNumber;
  if (dimension == 2 && (is_local || ranks == 1)) return Preconditioner::cholesky;
  if (dimension == 2 && num_unknowns <= kLargestWhole) return Preconditioner::cholesky_of_whole;
  return is_local ? Preconditioner::incomplete : Preconditioner::multigrid;
}

la::PetscLinearSolver create_pressure_solver(Mat product, Mat assembled, Preconditioner preconditioner,
                                             double tolerance) {
  if (preconditioner == Preconditioner::multigrid) set_multigrid_options();
  MPI_Comm comm = MPI_COMM_NULL;
  base::check(PetscObjectGetComm(reinterpret_cast<PetscObject>(assembled), &comm));
  auto solver = la::create_linear_solver(comm, {.prefix = "acoustic_",
                                                .method = KSPCG,
                                                .preconditioner = type_of(preconditioner),
                                                .relative_tolerance = tolerance,
                                                .largest_iterations = 2000,
                                                .start_from_given = true});
  base::check(KSPSetOperators(solver.get(), product, assembled));
  set_inner_solvers(solver.get(), preconditioner);
  return solver;
}

}  // namespace vocalis::acoustic
