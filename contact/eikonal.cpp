#include "contact/eikonal.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::contact {

namespace {

std::vector<PetscInt> rows_of_cells(const la::SystemLayout& layout, const fem::Space& space) {
  std::vector<PetscInt> rows;
  rows.reserve(space.cell_dofs.size());
  for (const std::int32_t dof : space.cell_dofs) rows.push_back(dof < 0 ? -1 : layout.global(0, dof, 0));
  return rows;
}

double largest_of(const fem::Field& field) {
  double value = 0;
  for (std::int32_t i = 0; i < field.space->dofs.num_owned; ++i) value = std::max(value, std::abs(field.values[i]));
  return base::largest(field.space->mesh->comm, value);
}

}  // namespace

Eikonal::Eikonal(const fem::Space& space)
    : space_(&space),
      layout_(space.mesh->comm, {{&space.dofs, 1}}),
      solver_(la::create_linear_solver(space.mesh->comm, {.prefix = "eikonal_",
                                                          .method = KSPGMRES,
                                                          .preconditioner = PCBJACOBI,
                                                          .relative_tolerance = 1e-10,
                                                          .largest_iterations = 2000,
                                                          .start_from_given = false})) {}

template <int D>
void Eikonal::compute_cells(std::span<const double> coordinates) {
  const mesh::Mesh& mesh = *space_->mesh;
  gradients_.assign(static_cast<std::size_t>(mesh.num_cells()) * (D + 1) * D, 0.0);
  measures_.assign(mesh.num_cells(), 0.0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (space_->dofs_of(cell)[0] < 0) continue;
    const auto vertices = mesh.vertices_of(cell);
    std::array<const double*, D + 1> corners;
    for (int i = 0; i <= D; ++i) corners[i] = coordinates.data() + static_cast<std::size_t>(vertices[i]) * D;
    const auto geometry = fem::simplex_geometry<D>(corners);
    measures_[cell] = geometry.measure;
    for (int i = 0; i <= D; ++i) {
      std::copy(geometry.gradient[i].begin(), geometry.gradient[i].end(),
                gradients_.begin() + (static_cast<std::ptrdiff_t>(cell) * (D + 1) + i) * D);
    }
  }
}

/// With a distance: Newton's matrix and minus the residual. Without: Poisson's equation with a source of one.
void Eikonal::assemble(const fem::Field* distance, double viscosity, std::span<const char> is_zero,
                       Vec right_hand_side) {
  const mesh::Mesh& mesh = *space_->mesh;
  const int d = mesh.dimension, n = d + 1;
  values_.assign(static_cast<std::size_t>(mesh.num_cells()) * n * n, 0.0);
  fem::Load load(*space_, 1);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space_->dofs_of(cell);
    if (dofs[0] < 0) continue;
    const double* gradient = gradients_.data() + static_cast<std::size_t>(cell) * n * d;
    double slope[3] = {0, 0, 0}, length = 1, epsilon = 1;
    if (distance) {
      for (int i = 0; i < n * d; ++i) slope[i % d] += distance->values[dofs[i / d]] * gradient[i];
      length = std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
      // Where D has no slope, in cells whose corners are all zero, any direction serves.
      const double direction[3] = {length > 1e-12 ? slope[0] / length : 1.0, length > 1e-12 ? slope[1] / length : 0.0,
                                   length > 1e-12 ? slope[2] / length : 0.0};
      double inverse = 0;
      for (int i = 0; i < n; ++i) {
        double along = 0;
        for (int k = 0; k < d; ++k) along += direction[k] * gradient[i * d + k];
        inverse += 0.5 * std::abs(along);
      }
      epsilon = viscosity / inverse;
    }
    const double mean = measures_[cell] / n;
    double* matrix = values_.data() + static_cast<std::size_t>(cell) * n * n;
    for (int j = 0; j < n; ++j) {
      double along = 0, by_slope = 0;
      for (int k = 0; k < d; ++k) by_slope += slope[k] * gradient[j * d + k];
      if (distance && length > 1e-12) along = by_slope / length;
      for (int i = 0; i < n; ++i) {
        double both = 0;
        for (int k = 0; k < d; ++k) both += gradient[i * d + k] * gradient[j * d + k];
        matrix[i * n + j] = mean * along + measures_[cell] * epsilon * both;
      }
      load.values[dofs[j]] -= distance ? mean * (length - 1) + measures_[cell] * epsilon * by_slope : -mean;
    }
  }
  matrix_->assemble(values_);
  load.add_to_owners();
  const la::OwnedValues out(right_hand_side);
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) out[i] = is_zero[i] ? 0.0 : load.values[i];
}

la::SolveReport Eikonal::solve_linear(Vec right_hand_side, fem::Field& solution) {
  base::check(KSPSetOperators(solver_.get(), matrix_->get(), matrix_->get()));
  const la::PetscVector found = la::create_vector(layout_.comm(), layout_.num_owned());
  const la::SolveReport report = la::solve(solver_.get(), right_hand_side, found.get());
  const la::ReadValues values(found.get());
  std::copy_n(values.data(), layout_.num_owned(), solution.values.begin());
  solution.copy_to_ghosts();
  return report;
}

/// sqrt(|∇φ|² + 2 φ) - |∇φ| with -Δφ = 1: the distance itself between two planes.
void Eikonal::start(std::span<const char> is_zero, fem::Field& distance, EikonalReport& report) {
  const mesh::Mesh& mesh = *space_->mesh;
  const int d = mesh.dimension, n = d + 1;
  const la::PetscVector right_hand_side = la::create_vector(layout_.comm(), layout_.num_owned());
  assemble(nullptr, 1, is_zero, right_hand_side.get());
  fem::Field potential(*space_, 1);
  report.linear_iterations += solve_linear(right_hand_side.get(), potential).iterations;
  fem::Load slopes(*space_, d + 1);  // measure x gradient, and measure
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space_->dofs_of(cell);
    if (dofs[0] < 0) continue;
    const double* gradient = gradients_.data() + static_cast<std::size_t>(cell) * n * d;
    double slope[3] = {0, 0, 0};
    for (int i = 0; i < n * d; ++i) slope[i % d] += potential.values[dofs[i / d]] * gradient[i];
    for (const std::int32_t dof : dofs) {
      for (int k = 0; k < d; ++k) slopes.at(dof)[k] += measures_[cell] * slope[k];
      slopes.at(dof)[d] += measures_[cell];
    }
  }
  slopes.add_to_owners();
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) {
    const double* sum = slopes.at(i);
    double square = 0;
    for (int k = 0; k < d; ++k) square += sum[k] * sum[k] / (sum[d] * sum[d]);
    distance.values[i] =
        is_zero[i] ? 0.0 : std::sqrt(square + 2 * std::max(potential.values[i], 0.0)) - std::sqrt(square);
  }
  distance.copy_to_ghosts();
}

EikonalReport Eikonal::solve(std::span<const double> coordinates, std::span<const char> is_zero,
                             const EikonalSettings& settings, fem::Field& distance) {
  space_->mesh->dimension == 2 ? compute_cells<2>(coordinates) : compute_cells<3>(coordinates);
  std::vector<PetscInt> constrained;
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) {
    if (!is_zero[i]) continue;
    constrained.push_back(i);
    distance.values[i] = 0;
  }
  matrix_ = std::make_unique<la::AssembledMatrix>(layout_, rows_of_cells(layout_, *space_), space_->dofs_per_cell,
                                                  constrained, true);
  EikonalReport report;
  distance.copy_to_ghosts();
  if (largest_of(distance) == 0) start(is_zero, distance, report);
  const la::PetscVector right_hand_side = la::create_vector(layout_.comm(), layout_.num_owned());
  fem::Field change(*space_, 1);
  while (report.iterations < settings.largest_iterations) {
    assemble(&distance, settings.viscosity, is_zero, right_hand_side.get());
    const la::SolveReport solved = solve_linear(right_hand_side.get(), change);
    report.linear_iterations += solved.iterations;
    if (!solved.converged) {
      report.reason = "linear system of the distance: " + solved.reason;
      return report;
    }
    ++report.iterations;
    for (std::size_t i = 0; i < change.values.size(); ++i) distance.values[i] += change.values[i];
    if (largest_of(change) <= settings.tolerance * largest_of(distance)) {
      report.converged = true;
      return report;
    }
  }
  report.reason = "the distance did not converge";
  return report;
}

}  // namespace vocalis::contact
