#include "acoustic_solver/pressure_system.hpp"

#include <algorithm>
#include <string>

namespace vocalis::acoustic {

namespace {

std::vector<PetscInt> rows_of_cells(const la::SystemLayout& layout, const fem::Space& space) {
  std::vector<PetscInt> rows;
  rows.reserve(space.cell_dofs.size());
  for (const std::int32_t dof : space.cell_dofs) rows.push_back(layout.global(0, dof, 0));
  return rows;
}

std::vector<PetscInt> as_petsc(const std::vector<std::int32_t>& positions) {
  return {positions.begin(), positions.end()};
}

/// The solver of each rank's block, unless the options say otherwise.
void set_block_preconditioner(KSP solver, const char* type) {
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
    base::check(PCSetType(block, type));
  }
}

}  // namespace

PressureSystem::PressureSystem(const mesh::Mesh& mesh, const fem::Space& space,
                               const std::vector<std::int32_t>& constrained, double tolerance)
    : layout_(mesh.comm, {{&space.dofs, 1}}),
      constrained_(constrained),
      tolerance_(tolerance),
      dimension_(mesh.dimension),
      matrix_(layout_, rows_of_cells(layout_, space), space.dofs_per_cell, as_petsc(constrained), true),
      right_hand_side_(la::create_vector(mesh.comm, layout_.num_owned())),
      solution_(la::create_vector(mesh.comm, layout_.num_owned())) {
  base::check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
}

void PressureSystem::create_solver() {
  solver_ = la::create_linear_solver(layout_.comm(), {.prefix = "acoustic_",
                                                      .method = KSPCG,
                                                      .preconditioner = PCBJACOBI,
                                                      .relative_tolerance = tolerance_,
                                                      .largest_iterations = 2000,
                                                      .start_from_given = true});
  base::check(KSPSetOperators(solver_.get(), matrix_.get(), matrix_.get()));
  // Measured (tests/benchmarks/acoustic_integrators.cpp): a plane block is factorised in the time of a few solves, and
  // the factors of an earlier geometry serve for long; in space they cost too much.
  set_block_preconditioner(solver_.get(), dimension_ == 2 ? PCCHOLESKY : PCICC);
}

void PressureSystem::assemble(const WaveOperator& wave, const Layers& layers, double a, double b) {
  wave.system_values(a, b, values_);
  layers.add_system_values(1 / a, values_);
  matrix_.assemble(values_);
  if (!assembled_ || a != a_ || b != b_) rebuild_ = true;
  if (!assembled_) create_solver();
  base::check(KSPSetReusePreconditioner(solver_.get(), rebuild_ ? PETSC_FALSE : PETSC_TRUE));
  if (rebuild_) iterations_when_new_ = -1;
  rebuild_ = false;
  a_ = a;
  b_ = b;
  assembled_ = true;
}

la::SolveReport PressureSystem::solve(std::span<const double> right_hand_side, std::span<double> solution) {
  const PetscInt num_owned = layout_.num_owned();
  {
    const la::OwnedValues b(right_hand_side_.get());
    const la::OwnedValues x(solution_.get());
    std::copy_n(right_hand_side.data(), num_owned, b.data());
    std::copy_n(solution.data(), num_owned, x.data());
    for (const std::int32_t position : constrained_) b[position] = x[position] = 0;
  }
  const la::SolveReport report = la::solve(solver_.get(), right_hand_side_.get(), solution_.get());
  if (iterations_when_new_ < 0) {
    iterations_when_new_ = report.iterations;
  } else if (report.iterations > iterations_when_new_ + iterations_when_new_ / 4 + 2) {
    rebuild_ = true;
  }
  const la::ReadValues x(solution_.get());
  std::copy_n(x.data(), num_owned, solution.data());
  return report;
}

}  // namespace vocalis::acoustic
