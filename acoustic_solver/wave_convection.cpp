#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "acoustic_solver/wave_operator.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

/// Owned cells with a vertex whose row of (vertices, dimension) values is not zero.
std::vector<std::int32_t> cells_with(const mesh::Mesh& mesh, std::span<const double> velocity) {
  if (velocity.empty()) return {};
  const int d = mesh.dimension;
  std::vector<char> marks(mesh.num_vertices(), 0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const auto first = velocity.begin() + static_cast<std::ptrdiff_t>(v) * d;
    marks[v] = std::any_of(first, first + d, [](double value) { return value != 0; });
  }
  std::vector<std::int32_t> cells;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      if (!marks[v]) continue;
      cells.push_back(cell);
      break;
    }
  }
  return cells;
}

}  // namespace

void WaveOperator::set_velocity(std::span<const double> of_mesh, std::span<const double> of_medium) {
  assert(of_mesh.empty() || of_medium.empty() || of_mesh.size() == of_medium.size());
  mesh_velocity_.assign(of_mesh.begin(), of_mesh.end());
  medium_velocity_.assign(of_medium.begin(), of_medium.end());
  velocity_ = mesh_velocity_;
  velocity_.resize(std::max(mesh_velocity_.size(), medium_velocity_.size()), 0.0);
  for (std::size_t i = 0; i < medium_velocity_.size(); ++i) velocity_[i] -= medium_velocity_[i];
  convecting_cells_ = cells_with(*mesh_, velocity_);
  moving_cells_ = cells_with(*mesh_, mesh_velocity_);
  flow_cells_ = cells_with(*mesh_, medium_velocity_);
  flows_ = base::largest(mesh_->comm, static_cast<std::int32_t>(flow_cells_.size())) > 0;
  moving_walls_.clear();
  const auto has_velocity = [&](const BoundaryFacet& facet, const std::vector<double>& velocity) {
    const int d = mesh_->dimension;
    const auto vertices = mesh_->vertices_of(facet.cell);
    for (int i = 0; i <= d; ++i) {
      const auto first = velocity.begin() + static_cast<std::ptrdiff_t>(vertices[i]) * d;
      if (i != facet.index && std::any_of(first, first + d, [](double value) { return value != 0; })) return true;
    }
    return false;
  };
  for (const BoundaryFacet& facet : facets_) {
    if (!mesh_velocity_.empty() && facet.is_wall() && has_velocity(facet, mesh_velocity_)) {
      moving_walls_.push_back(facet);
    }
  }
  const auto has = [&](const std::vector<double>& velocity, std::int32_t v) {
    const auto first = velocity.begin() + static_cast<std::ptrdiff_t>(v) * mesh_->dimension;
    return !velocity.empty() && std::any_of(first, first + mesh_->dimension, [](double value) { return value != 0; });
  };
  inlets_.clear();
  std::vector<std::int32_t> marks(mesh_->num_vertices(), 0);
  for (const std::int32_t v : released_) marks[v] = has(medium_velocity_, v) && !has(mesh_velocity_, v);
  if (flows_) space_->halo.copy_to_ghosts(marks);
  for (std::int32_t v = 0; v < mesh_->num_vertices(); ++v) {
    if (marks[v] != 0) inlets_.push_back(v);
  }
  has_inlets_ = flows_ && base::largest(mesh_->comm, static_cast<std::int32_t>(inlets_.size())) > 0;
}

double WaveOperator::largest_flow_speed() const {
  const int d = mesh_->dimension;
  double largest = 0;
  for (auto u = medium_velocity_.begin(); u != medium_velocity_.end(); u += d) {
    largest = std::max(largest, std::inner_product(u, u + d, u, 0.0));
  }
  return std::sqrt(largest);
}

template <int D>
void WaveOperator::add_mesh_convection(std::span<const double> pressure, std::span<double> sums) const {
  for (const std::int32_t cell : moving_cells_) {
    const std::int32_t* vertices = corners<D>(cell);
    const std::array<double, D> up = slope<D>(cell, pressure);
    std::array<double, D + 1> rate = {};  // of ∇p with β at each vertex
    double total = 0;
    for (int i = 0; i <= D; ++i) {
      const double* beta = mesh_velocity_.data() + static_cast<std::size_t>(vertices[i]) * D;
      for (int k = 0; k < D; ++k) rate[i] += beta[k] * up[k];
      total += rate[i];
    }
    const double weight = inverse_bulk_modulus_ * measures_[cell] / ((D + 1) * (D + 2));
    for (int i = 0; i <= D; ++i) sums[vertices[i]] += weight * (total + rate[i]);
  }
}

void WaveOperator::add_convection(std::span<const double> pressure, std::span<const double> momentum,
                                  std::span<double> sums) const {
  mesh_->dimension == 2 ? add_mesh_convection<2>(pressure, sums) : add_mesh_convection<3>(pressure, sums);
  if (flows_) add_flow(pressure, momentum, sums);
}

std::vector<double> WaveOperator::momentum(std::span<const double> pressure) const {
  if (!flows_) return {};
  const int d = mesh_->dimension;
  std::vector<double> sums(mesh_->num_vertices(), 0.0);
  for (const std::int32_t cell : flow_cells_) {
    const auto vertices = mesh_->vertices_of(cell);
    double total = 0;
    for (const std::int32_t v : vertices) total += pressure[v];
    const double weight = inverse_bulk_modulus_ * measures_[cell] / ((d + 1) * (d + 2));
    for (const std::int32_t v : vertices) sums[v] += weight * (total + pressure[v]);
  }
  space_->halo.add_to_owners(sums);
  space_->halo.copy_to_ghosts(sums);
  return sums;
}

std::vector<double> WaveOperator::flow_measures() const {
  std::vector<double> sums(mesh_->num_vertices(), 0.0);
  for (const std::int32_t cell : flow_cells_) {
    for (const std::int32_t v : mesh_->vertices_of(cell)) sums[v] += measures_[cell];
  }
  space_->halo.add_to_owners(sums);
  space_->halo.copy_to_ghosts(sums);
  return sums;
}

template <int D>
void WaveOperator::add_flow_of_cells(std::span<const double> momentum, const std::vector<double>& around,
                                     std::span<double> sums) const {
  for (const std::int32_t cell : flow_cells_) {
    const std::int32_t* vertices = corners<D>(cell);
    const double* g = gradient(cell, 0);
    std::array<double, D> flux = {};
    for (int i = 0; i <= D; ++i) {
      const double* u = medium_velocity_.data() + static_cast<std::size_t>(vertices[i]) * D;
      const double part = momentum[vertices[i]] * measures_[cell] / around[vertices[i]];
      for (int k = 0; k < D; ++k) flux[k] += part * u[k];
    }
    for (int i = 0; i <= D; ++i) {
      double product = 0;
      for (int k = 0; k < D; ++k) product += flux[k] * g[i * D + k];
      sums[vertices[i]] += product;
    }
  }
}

void WaveOperator::add_flow(std::span<const double> pressure, std::span<const double> momentum,
                            std::span<double> sums) const {
  const int d = mesh_->dimension;
  const std::vector<double> around = flow_measures();
  d == 2 ? add_flow_of_cells<2>(momentum, around, sums) : add_flow_of_cells<3>(momentum, around, sums);
  if (medium_velocity_.empty()) return;
  for (const BoundaryFacet& facet : moving_walls_) {
    const double* inward = gradient(facet.cell, facet.index);
    const double length = std::sqrt(std::inner_product(inward, inward + d, inward, 0.0));
    const double weight = inverse_bulk_modulus_ * facet_weight(facet) / length;
    const auto vertices = mesh_->vertices_of(facet.cell);
    double carried[4], total = 0;  // -U·n p at each vertex
    for (int i = 0; i <= d; ++i) {
      const double* u = medium_velocity_.data() + static_cast<std::size_t>(vertices[i]) * d;
      carried[i] = i == facet.index ? 0 : std::inner_product(u, u + d, inward, 0.0) * pressure[vertices[i]];
      total += carried[i];
    }
    for (int i = 0; i <= d; ++i) {
      if (i != facet.index) sums[vertices[i]] += weight * (total + carried[i]);
    }
  }
}

template <int D>
void WaveOperator::add_slopes(std::span<const double> potential, int columns, std::span<double> sums) const {
  for (const std::int32_t cell : convecting_cells_) {
    const std::int32_t* vertices = corners<D>(cell);
    std::array<double, D> up = slope<D>(cell, potential);
    for (double& value : up) value *= measures_[cell];
    for (int i = 0; i <= D; ++i) {
      double* sum = sums.data() + static_cast<std::size_t>(vertices[i]) * columns;
      for (int k = 0; k < D; ++k) sum[k] += up[k];
      sum[D] += measures_[cell];
    }
  }
}

void WaveOperator::potential_convection(std::span<const double> potential, std::span<const double> pressure,
                                        std::vector<double>& rates,
                                        std::span<const std::vector<double>> wall_velocities) const {
  // Sums at a vertex: measure x gradient over its cells, measure; then over its moving walls, each weighed by area and
  // normal velocity: normal, u·n, weight. So where a moving wall meets one that slides along itself the first decides.
  const int d = mesh_->dimension;
  const int columns = 2 * d + 3;
  std::vector<double> sums(static_cast<std::size_t>(mesh_->num_vertices()) * columns, 0.0);
  d == 2 ? add_slopes<2>(potential, columns, sums) : add_slopes<3>(potential, columns, sums);
  for (const BoundaryFacet& facet : moving_walls_) {
    const double* inward = gradient(facet.cell, facet.index);
    const double length = std::sqrt(std::inner_product(inward, inward + d, inward, 0.0));
    const auto vertices = mesh_->vertices_of(facet.cell);
    for (int i = 0; i <= d; ++i) {
      if (i == facet.index) continue;
      const double* beta = mesh_velocity_.data() + static_cast<std::size_t>(vertices[i]) * d;
      const double weight = std::abs(std::inner_product(beta, beta + d, inward, 0.0)) / length * facet_weight(facet);
      double* sum = sums.data() + static_cast<std::size_t>(vertices[i]) * columns + d + 1;
      for (int k = 0; k < d; ++k) sum[k] -= weight * inward[k] / length;
      sum[d] += weight * facet.on_pressure * pressure[vertices[i]];
      if (facet.wall >= 0) sum[d] += weight * wall_velocities[facet.wall][vertices[i]];
      sum[d + 1] += weight;
    }
  }
  space_->halo.add_to_owners(sums, columns);
  space_->halo.copy_to_ghosts(sums, columns);
  rates.assign(mesh_->num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh_->num_vertices(); ++v) {
    const double* sum = sums.data() + static_cast<std::size_t>(v) * columns;
    if (sum[d] == 0) continue;
    const double* velocity = velocity_.data() + static_cast<std::size_t>(v) * d;
    rates[v] = std::inner_product(velocity, velocity + d, sum, 0.0) / sum[d];
    const double* wall = sum + d + 1;
    const double square = std::inner_product(wall, wall + d, wall, 0.0);
    if (square <= 1e-20 * wall[d + 1] * wall[d + 1]) continue;
    const double normal_slope = std::inner_product(wall, wall + d, sum, 0.0) / (std::sqrt(square) * sum[d]);
    const double normal_velocity = std::inner_product(velocity, velocity + d, wall, 0.0) / std::sqrt(square);
    rates[v] -= normal_velocity * (normal_slope + wall[d] / wall[d + 1]);
  }
}

}  // namespace vocalis::acoustic
