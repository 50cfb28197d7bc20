#include "transfer/point_interpolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/cell_tree.hpp"

namespace vocalis::transfer {

namespace {

/// Held points are owned where their cells are; their takers are ghosts of them. Collective.
base::IndexMap takers_as_ghosts(MPI_Comm comm, const PointSearch& search, const std::vector<std::size_t>& takers) {
  base::IndexMap map = base::contiguous_index_map(comm, static_cast<std::int32_t>(search.held.size()));
  const std::vector<std::int64_t> offsets = base::gather_all(comm, map.offset);
  for (const std::size_t j : takers) {
    const Holder& holder = search.holders[j];
    map.ghost_owner.push_back(holder.rank);
    map.ghost_global.push_back(offsets[holder.rank] + holder.place);
  }
  return map;
}

bool is_near(const Holder& holder) { return holder.rank >= 0 && holder.distance <= holder.cell_size; }

/// Collective.
PointsOutside points_outside(const mesh::Mesh& mesh, std::span<const double> points,
                             const std::vector<Holder>& holders) {
  PointsOutside result;
  for (std::size_t j = 0; j < holders.size(); ++j) {
    const Holder& holder = holders[j];
    if (holder.rank >= 0 && holder.distance == 0) continue;
    const double cells = holder.rank < 0 ? mesh::Box::infinity : holder.distance / holder.cell_size;
    ++result.count;
    result.distance = std::max(result.distance, holder.rank < 0 ? mesh::Box::infinity : holder.distance);
    if (cells <= result.cells) continue;
    result.cells = cells;
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(j * mesh.dimension), mesh.dimension, result.point.begin());
  }
  const std::vector<double> cells = base::gather_all(mesh.comm, result.cells);
  const auto worst = std::max_element(cells.begin(), cells.end());
  MPI_Bcast(result.point.data(), 3, MPI_DOUBLE, static_cast<int>(worst - cells.begin()), mesh.comm);
  return {base::sum(mesh.comm, result.count), base::largest(mesh.comm, result.distance), *worst, result.point};
}

bool is_on_vertices(const fem::Space& space) {
  return space.degree == 1 && space.num_dofs() == space.mesh->num_vertices();
}

}  // namespace

PointInterpolation::PointInterpolation(const mesh::Mesh& mesh, std::span<const double> points,
                                       std::span<const std::int32_t> cell_counts)
    : num_points_(points.size() / mesh.dimension) {
  PointSearch search = search_points(mesh, points, cell_counts);
  outside_ = points_outside(mesh, points, search.holders);
  for (std::size_t j = 0; j < num_points_; ++j) {
    if (is_near(search.holders[j])) takers_.push_back(j);
  }
  halo_ = base::Halo(takers_as_ghosts(mesh.comm, search, takers_));
  held_ = std::move(search.held);
}

void PointInterpolation::require_all(const std::string& rule) const {
  if (outside_.cells <= 1) return;
  const auto& [x, y, z] = outside_.point;
  throw base::UserError(rule,
                        fmt::format("({:.6g}, {:.6g}, {:.6g}) m further outside than the longest edge of the nearest "
                                    "cell; {} points outside in all",
                                    x, y, z, outside_.count),
                        "draw both after the same shape at rest");
}

std::vector<std::int32_t> PointInterpolation::is_held() const {
  std::vector<std::int32_t> result(num_points_, 0);
  for (const std::size_t j : takers_) result[j] = 1;
  return result;
}

void PointInterpolation::evaluate(const fem::Field& field, std::span<double> at_points) const {
  assert(is_on_vertices(*field.space) && at_points.size() == num_points_ * field.components);
  const int n = field.components;
  std::vector<double> values((held_.size() + takers_.size()) * n, 0.0);
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const auto vertices = field.space->mesh->vertices_of(held_[i].cell);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      for (int c = 0; c < n; ++c) values[i * n + c] += held_[i].barycentric[k] * field.at(vertices[k])[c];
    }
  }
  halo_.copy_to_ghosts(values, n);
  std::fill(at_points.begin(), at_points.end(), 0.0);
  for (std::size_t i = 0; i < takers_.size(); ++i) {
    for (int c = 0; c < n; ++c) at_points[takers_[i] * n + c] = values[(held_.size() + i) * n + c];
  }
}

void PointInterpolation::restrict_to(std::span<const double> at_points, fem::Load& load) const {
  assert(is_on_vertices(*load.space) && at_points.size() == num_points_ * load.components);
  const int n = load.components;
  std::vector<double> values(held_.size() * n, 0.0);
  for (const std::size_t j : takers_) {
    for (int c = 0; c < n; ++c) values.push_back(at_points[j * n + c]);
  }
  halo_.add_to_owners(values, n);
  std::fill(load.values.begin(), load.values.end(), 0.0);
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const auto vertices = load.space->mesh->vertices_of(held_[i].cell);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      for (int c = 0; c < n; ++c) load.at(vertices[k])[c] += held_[i].barycentric[k] * values[i * n + c];
    }
  }
  load.add_to_owners();
}

}  // namespace vocalis::transfer
