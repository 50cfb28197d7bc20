#include "acoustic_solver/wave_operator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>

#include "acoustic_solver/cell_length.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/facets.hpp"

namespace vocalis::acoustic {

WaveOperator::WaveOperator(const mesh::Mesh& mesh, const fem::Space& space, const AcousticSettings& settings)
    : mesh_(&mesh),
      space_(&space),
      inverse_bulk_modulus_(1 / (settings.density * settings.speed_of_sound * settings.speed_of_sound)),
      density_(settings.density),
      subscale_time_(settings.subscale_constant / (settings.speed_of_sound * settings.density)),
      facets_(boundary_conditions(mesh, settings)),
      coordinates_(mesh.coordinates),
      gradients_(static_cast<std::size_t>(mesh.num_cells()) * (mesh.dimension + 1) * mesh.dimension),
      measures_(mesh.num_cells()) {
  if (settings.velocity_elements == VelocityElements::p1) subscales_.emplace(mesh, space);
  for (const AcousticBoundary& boundary : settings.boundaries) {
    wall_branches_.push_back(acoustic::wall_branches(settings, boundary));
  }
  const std::vector<char> all(mesh.num_vertices(), 1);
  mesh.dimension == 2 ? compute_cells<2>(all) : compute_cells<3>(all);
  std::vector<mesh::NamedFacet> free_facets;
  for (const BoundaryFacet& facet : facets_) {
    if (facet.is_released) free_facets.push_back({facet.cell, facet.index, -1});
  }
  const auto marks = mesh::mark_vertices(mesh, free_facets);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    if (marks[v]) released_.push_back(v);
  }
}

bool WaveOperator::set_geometry(std::span<const double> coordinates) {
  assert(coordinates.size() == coordinates_.size());
  const int d = mesh_->dimension;
  std::vector<char> moved(mesh_->num_vertices(), 0);
  bool any = false;
  for (std::int32_t v = 0; v < mesh_->num_vertices(); ++v) {
    const auto first = static_cast<std::ptrdiff_t>(v) * d;
    if (std::equal(coordinates.begin() + first, coordinates.begin() + first + d, coordinates_.begin() + first))
      continue;
    moved[v] = 1;
    any = true;
  }
  if (!any) return false;
  std::copy(coordinates.begin(), coordinates.end(), coordinates_.begin());
  d == 2 ? compute_cells<2>(moved) : compute_cells<3>(moved);
  return true;
}

template <int D>
void WaveOperator::compute_cells(const std::vector<char>& vertex_moved) {
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    const auto vertices = mesh_->vertices_of(cell);
    if (std::none_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return vertex_moved[v]; })) continue;
    std::array<const double*, D + 1> corners;
    for (int i = 0; i <= D; ++i) corners[i] = coordinates_.data() + static_cast<std::size_t>(vertices[i]) * D;
    const auto geometry = fem::simplex_geometry<D>(corners);
    measures_[cell] = geometry.measure;
    for (int i = 0; i <= D; ++i) {
      std::copy(geometry.gradient[i].begin(), geometry.gradient[i].end(),
                gradients_.begin() + (static_cast<std::ptrdiff_t>(cell) * (D + 1) + i) * D);
    }
  }
}

double WaveOperator::facet_weight(const BoundaryFacet& facet) const {
  const int d = mesh_->dimension;
  const double* g = gradient(facet.cell, facet.index);
  double square = 0;
  for (int k = 0; k < d; ++k) square += g[k] * g[k];
  // A facet's measure is d times the cell's over the height, and 1 / height is the length of the gradient.
  return d * measures_[facet.cell] * std::sqrt(square) / (d * (d + 1));
}

template <int D>
void WaveOperator::system_values_of_cells(double a, double b, std::vector<double>& values) const {
  constexpr int n = D + 1;
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    double* entry = values.data() + static_cast<std::size_t>(cell) * n * n;
    const double* g = gradient(cell, 0);
    const double mass = a * inverse_bulk_modulus_ * measures_[cell] / (n * (n + 1));
    const double stiffness = b * measures_[cell];
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        double product = 0;
        for (int k = 0; k < D; ++k) product += g[i * D + k] * g[j * D + k];
        entry[i * n + j] = (i == j ? 2 : 1) * mass + stiffness * product;
      }
    }
  }
}

void WaveOperator::system_values(double a, double b, std::vector<double>& values) const {
  const int n = mesh_->dimension + 1;
  values.resize(measures_.size() * n * n);
  n == 3 ? system_values_of_cells<2>(a, b, values) : system_values_of_cells<3>(a, b, values);
  for (const BoundaryFacet& facet : facets_) {
    double coefficient = facet.on_pressure + b * facet.on_potential;
    if (facet.wall >= 0) {
      for (const WallBranch& branch : wall_branches_[facet.wall]) coefficient += branch.step_admittance(1 / a);
    }
    if (coefficient == 0) continue;
    const double weight = coefficient * facet_weight(facet);
    double* entry = values.data() + static_cast<std::size_t>(facet.cell) * n * n;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        if (i != facet.index && j != facet.index) entry[i * n + j] += (i == j ? 2 : 1) * weight;
      }
    }
  }
}

double WaveOperator::smallest_length() const {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    smallest = std::min(smallest, cell_length(*mesh_, coordinates_, cell));
  }
  return smallest;
}

std::vector<double> WaveOperator::subscale_weights(double factor, bool damps) const {
  std::vector<double> weights = measures_;
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    weights[cell] *= damps ? factor * subscale_time_ * cell_length(*mesh_, coordinates_, cell) : factor;
  }
  return weights;
}

void WaveOperator::add_subscales(double b, std::span<const double> x, std::span<double> sums) const {
  if (!subscales_) return;
  subscales_->add(gradients_, subscale_weights(-b, false), x, sums);
  if (subscale_time_ > 0) subscales_->add(gradients_, subscale_weights(1, true), x, sums);
}

template <int D>
inline void WaveOperator::add_stiffness_of_cell(std::int32_t cell, double factor, std::span<const double> potential,
                                                std::span<double> sums) const {
  const std::int32_t* vertices = corners<D>(cell);
  const double* g = gradient(cell, 0);
  const std::array<double, D> down = slope<D>(cell, potential);
  for (int i = 0; i <= D; ++i) {
    double product = 0;
    for (int k = 0; k < D; ++k) product += down[k] * g[i * D + k];
    sums[vertices[i]] += factor * measures_[cell] * product;
  }
}

void WaveOperator::add_stiffness_of_rest(double factor, std::span<const double> potential,
                                         std::span<double> sums) const {
  const int d = mesh_->dimension;
  if (subscales_) subscales_->add(gradients_, subscale_weights(-factor, false), potential, sums);
  for (const BoundaryFacet& facet : facets_) {
    if (facet.on_potential == 0) continue;
    const double weight = factor * facet.on_potential * facet_weight(facet);
    const auto vertices = mesh_->vertices_of(facet.cell);
    double total = 0;
    for (int i = 0; i <= d; ++i) total += i == facet.index ? 0 : potential[vertices[i]];
    for (int i = 0; i <= d; ++i) {
      if (i != facet.index) sums[vertices[i]] += weight * (total + potential[vertices[i]]);
    }
  }
}

void WaveOperator::add_stiffness(double factor, std::span<const double> potential, std::span<double> sums) const {
  const bool is_plane = mesh_->dimension == 2;
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    is_plane ? add_stiffness_of_cell<2>(cell, factor, potential, sums)
             : add_stiffness_of_cell<3>(cell, factor, potential, sums);
  }
  add_stiffness_of_rest(factor, potential, sums);
}

void WaveOperator::add_convecting_stiffness(double factor, std::span<const double> potential,
                                            std::span<double> sums) const {
  const bool is_plane = mesh_->dimension == 2;
  for (const std::int32_t cell : convecting_cells_) {
    is_plane ? add_stiffness_of_cell<2>(cell, factor, potential, sums)
             : add_stiffness_of_cell<3>(cell, factor, potential, sums);
  }
  add_stiffness_of_rest(factor, potential, sums);
}

void WaveOperator::add_admittance(double factor, std::span<const double> pressure, std::span<double> sums) const {
  if (subscale_time_ > 0 && subscales_) subscales_->add(gradients_, subscale_weights(factor, true), pressure, sums);
  add_facet_admittance(factor, pressure, sums, false);
}

void WaveOperator::add_open_admittance(double factor, std::span<const double> pressure, std::span<double> sums) const {
  add_facet_admittance(factor, pressure, sums, true);
}

void WaveOperator::add_facet_admittance(double factor, std::span<const double> pressure, std::span<double> sums,
                                        bool open_only) const {
  const int d = mesh_->dimension;
  for (const BoundaryFacet& facet : facets_) {
    if (facet.on_pressure == 0 || (open_only && !facet.is_open)) continue;
    const double weight = factor * facet.on_pressure * facet_weight(facet);
    const auto vertices = mesh_->vertices_of(facet.cell);
    double total = 0;
    for (int i = 0; i <= d; ++i) total += i == facet.index ? 0 : pressure[vertices[i]];
    for (int i = 0; i <= d; ++i) {
      if (i != facet.index) sums[vertices[i]] += weight * (total + pressure[vertices[i]]);
    }
  }
}

void WaveOperator::add_flux(double g, std::span<double> sums) const {
  const int d = mesh_->dimension;
  for (const BoundaryFacet& facet : facets_) {
    if (!facet.is_flux) continue;
    const auto vertices = mesh_->vertices_of(facet.cell);
    for (int i = 0; i <= d; ++i) {
      if (i != facet.index) sums[vertices[i]] += g * (d + 1) * facet_weight(facet);
    }
  }
}

double WaveOperator::energy(std::span<const double> pressure, std::span<const double> potential) const {
  const int d = mesh_->dimension;
  double result = 0;
  for (std::int32_t cell = 0; cell < mesh_->num_cells(); ++cell) {
    const auto vertices = mesh_->vertices_of(cell);
    double total = 0, squares = 0, slope[3] = {0, 0, 0};
    for (int i = 0; i <= d; ++i) {
      const double p = pressure[vertices[i]];
      total += p;
      squares += p * p;
      for (int k = 0; k < d; ++k) slope[k] += potential[vertices[i]] * gradient(cell, i)[k];
    }
    const double speed_square = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
    result += 0.5 * measures_[cell] *
              (inverse_bulk_modulus_ * (total * total + squares) / ((d + 1) * (d + 2)) + density_ * speed_square);
  }
  if (subscales_) {
    std::vector<double> sums(potential.size(), 0.0);
    subscales_->add(gradients_, measures_, potential, sums);
    result -= 0.5 * density_ * std::inner_product(sums.begin(), sums.end(), potential.begin(), 0.0);
  }
  return base::sum(mesh_->comm, result);
}

}  // namespace vocalis::acoustic
