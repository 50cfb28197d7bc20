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

double dot(const double* a, const double* b, int d) {
  double sum = 0;
  for (int k = 0; k < d; ++k) sum += a[k] * b[k];
  return sum;
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
                                                          .relative_tolerance = 1e-2,  // of a Newton step
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

/// Facets without a cell behind them, but for those in planes of symmetry. (On walls D is given: it does not matter.)
void Eikonal::find_open_facets(std::span<const double> coordinates, std::span<const SymmetryPlane> planes) {
  const mesh::Mesh& mesh = *space_->mesh;
  const int n = mesh.dimension + 1;
  is_open_.assign(static_cast<std::size_t>(mesh.num_cells()) * n, 0);
  for (std::size_t f = 0; f < is_open_.size(); ++f) is_open_[f] = mesh.cell_neighbours[f] < 0;
  for (const SymmetryPlane& plane : planes) {
    const std::vector<char> on_plane = vertices_on_plane(mesh, coordinates, plane);
    for (std::size_t f = 0; f < is_open_.size(); ++f) {
      const auto vertices = mesh.vertices_of(static_cast<std::int32_t>(f / n));
      bool lies_in_plane = true;
      for (int i = 0; i < n; ++i)
        lies_in_plane = lies_in_plane && (i == static_cast<int>(f % n) || on_plane[vertices[i]]);
      if (lies_in_plane) is_open_[f] = 0;
    }
  }
}

/// ∇D in a cell, its direction and length, and the artificial viscosity [m]. Without a distance those of Poisson's
/// equation: no slope, viscosity 1.
Eikonal::CellState Eikonal::state_of(std::int32_t cell, const fem::Field* distance, double viscosity) const {
  const int d = space_->mesh->dimension, n = d + 1;
  CellState state;
  if (!distance) return state;
  const auto dofs = space_->dofs_of(cell);
  const double* gradient = gradients_.data() + static_cast<std::size_t>(cell) * n * d;
  for (int i = 0; i < n * d; ++i) state.slope[i % d] += distance->values[dofs[i / d]] * gradient[i];
  state.length = std::sqrt(dot(state.slope.data(), state.slope.data(), d));
  // Where D has no slope, in cells whose corners are all zero, any direction serves.
  static constexpr std::array<double, 3> any_direction = {1, 0, 0};
  const bool has_slope = state.length > 1e-12;
  for (int k = 0; k < d && has_slope; ++k) state.direction[k] = state.slope[k] / state.length;
  const double* direction = has_slope ? state.direction.data() : any_direction.data();
  double square = 0;  // of one over the cell's length
  for (int i = 0; i < n; ++i) square += 0.5 * std::pow(dot(direction, gradient + i * d, d), 2);
  state.viscosity = viscosity / std::sqrt(square);
  return state;
}

/// ∇q of each corner, (corners, dimension), with what leaves through open facets: through a facet F with D growing
/// outwards -∫_F ε (∂D/∂n)^+ q is -measure ε (∇D·∇λ_F)^- for the q of each of its corners, λ_F being one at the corner
/// opposite to it.
std::array<double, 12> Eikonal::test_gradients(std::int32_t cell, const CellState& state) const {
  const int d = space_->mesh->dimension, n = d + 1;
  const double* gradient = gradients_.data() + static_cast<std::size_t>(cell) * n * d;
  std::array<double, 12> test;
  std::copy_n(gradient, n * d, test.begin());
  for (int f = 0; f < n; ++f) {
    if (!is_open_[static_cast<std::size_t>(cell) * n + f] || dot(state.slope.data(), gradient + f * d, d) >= 0)
      continue;
    for (int i = 0; i < n * d; ++i) test[i] += i / d == f ? 0.0 : gradient[f * d + i % d];
  }
  return test;
}

/// ∫ ε n·∇(θ q) of `distance`.
void Eikonal::compute_source(const fem::Field& distance, double viscosity, std::span<const double> smoothness) {
  const mesh::Mesh& mesh = *space_->mesh;
  const int d = mesh.dimension;
  source_.assign(space_->num_dofs(), 0.0);
  for (std::int32_t cell = 0; cell < mesh.num_cells() && !smoothness.empty(); ++cell) {
    const auto dofs = space_->dofs_of(cell);
    if (dofs[0] < 0) continue;
    const CellState state = state_of(cell, &distance, viscosity);
    const std::array<double, 12> test = test_gradients(cell, state);
    const double weight = measures_[cell] * state.viscosity;
    for (std::size_t i = 0; i < dofs.size(); ++i) {
      source_[dofs[i]] += smoothness[dofs[i]] * weight * dot(&test[i * d], state.direction.data(), d);
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
  if (distance) std::copy(source_.begin(), source_.end(), load.values.begin());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space_->dofs_of(cell);
    if (dofs[0] < 0) continue;
    const CellState state = state_of(cell, distance, viscosity);
    const double* gradient = gradients_.data() + static_cast<std::size_t>(cell) * n * d;
    const std::array<double, 12> test = test_gradients(cell, state);
    const double mean = measures_[cell] / n, weight = measures_[cell] * state.viscosity;
    double* matrix = values_.data() + static_cast<std::size_t>(cell) * n * n;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        matrix[i * n + j] = mean * dot(state.direction.data(), gradient + j * d, d) +
                            weight * dot(test.data() + i * d, gradient + j * d, d);
      }
      load.values[dofs[i]] -=
          distance ? mean * (state.length - 1) + weight * dot(test.data() + i * d, state.slope.data(), d) : -mean;
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
                             std::span<const SymmetryPlane> planes, const EikonalSettings& settings,
                             std::span<const double> smoothness, fem::Field& distance) {
  space_->mesh->dimension == 2 ? compute_cells<2>(coordinates) : compute_cells<3>(coordinates);
  find_open_facets(coordinates, planes);
  std::vector<PetscInt> constrained;
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) {
    if (!is_zero[i]) continue;
    constrained.push_back(i);
    distance.values[i] = 0;
  }
  if (base::largest(layout_.comm(), !matrix_ || constrained != constrained_ ? 1 : 0)) {
    matrix_ = std::make_unique<la::AssembledMatrix>(layout_, rows_of_cells(layout_, *space_), space_->dofs_per_cell,
                                                    constrained, true);
    constrained_ = constrained;
  }
  EikonalReport report;
  distance.copy_to_ghosts();
  if (largest_of(distance) == 0) start(is_zero, distance, report);
  compute_source(distance, settings.viscosity, smoothness);
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
