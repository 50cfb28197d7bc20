#include "acoustic_solver/pressure_system.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

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

}  // namespace

PressureSystem::PressureSystem(const mesh::Mesh& mesh, const fem::Space& space,
                               const std::vector<std::int32_t>& constrained, const AcousticSettings& settings)
    : layout_(mesh.comm, {{&space.dofs, 1}}),
      constrained_(constrained),
      tolerance_(settings.solver_tolerance),
      speed_of_sound_(settings.speed_of_sound),
      dimension_(mesh.dimension),
      num_unknowns_(space.dofs.num_global),
      matrix_(layout_, rows_of_cells(layout_, space), space.dofs_per_cell, as_petsc(constrained), true),
      right_hand_side_(la::create_vector(mesh.comm, layout_.num_owned())),
      solution_(la::create_vector(mesh.comm, layout_.num_owned())) {
  base::check(MatSetOption(matrix_.get(), MAT_SPD, PETSC_TRUE));
  if (settings.velocity_elements == VelocityElements::p1) equal_order_.emplace(space, matrix_.get(), constrained);
}

void PressureSystem::prepare_solver(const WaveOperator& wave) {
  const int ranks = base::size(layout_.comm());
  const double sound_path = speed_of_sound_ * 2 / a_;  // a is 1 / (θ dt)
  // In the plane one rank does not ask, and assembles for several sounds at each sub-step.
  const bool asks = dimension_ == 3 || ranks > 1;
  const double courant_number = asks ? base::largest(layout_.comm(), sound_path / wave.smallest_length()) : 0;
  const auto wanted = choose_preconditioner(dimension_, ranks, courant_number, num_unknowns_);
  if (assembled_ && wanted == preconditioner_) return;
  preconditioner_ = wanted;
  solver_ =
      create_pressure_solver(equal_order_ ? equal_order_->get() : matrix_.get(), matrix_.get(), wanted, tolerance_);
}

void PressureSystem::assemble(const WaveOperator& wave, const Layers& layers, double a, double b, double time,
                              bool is_solved_often) {
  wave.system_values(a, b, values_);
  layers.add_system_values(1 / a, values_);
  matrix_.assemble(values_);
  if (equal_order_) equal_order_->set(wave, b);
  if (!assembled_ || a != a_ || b != b_) rebuild_ = true;
  a_ = a;
  b_ = b;
  time_ = time;
  // The factors of a whole plane system are its inverse: no iterations, worth it for several solves.
  const bool may_be_exact = is_solved_often && dimension_ == 2 && !equal_order_;
  if (rebuild_ || may_be_exact) prepare_solver(wave);
  const bool is_alone = base::size(layout_.comm()) == 1;
  is_exact_ =
      may_be_exact && preconditioner_ == (is_alone ? Preconditioner::cholesky : Preconditioner::cholesky_of_whole);
  if (is_exact_) rebuild_ = true;
  base::check(KSPSetReusePreconditioner(solver_.get(), rebuild_ ? PETSC_FALSE : PETSC_TRUE));
  if (rebuild_) iterations_when_new_ = -1;
  rebuild_ = false;
  assembled_ = true;
}

la::SolveReport PressureSystem::apply_factors() {
  PC factors = nullptr;
  base::check(KSPGetPC(solver_.get(), &factors));
  base::check(KSPSetUp(solver_.get()));
  base::check(PCApply(factors, right_hand_side_.get(), solution_.get()));
  la::SolveReport report;
  report.converged = true;
  report.iterations = 1;
  return report;
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
  const la::SolveReport report =
      is_exact_ ? apply_factors() : la::solve(solver_.get(), right_hand_side_.get(), solution_.get());
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
