#include "transfer/point_interpolation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::transfer {

namespace {

/// Held points are owned where their cells are; the points themselves are ghosts of them. Collective.
base::IndexMap points_as_ghosts(MPI_Comm comm, const PointSearch& search) {
  base::IndexMap map = base::contiguous_index_map(comm, static_cast<std::int32_t>(search.held.size()));
  const std::vector<std::int64_t> offsets = base::gather_all(comm, map.offset);
  for (const Holder& holder : search.holders) {
    map.ghost_owner.push_back(holder.rank);
    map.ghost_global.push_back(offsets[holder.rank] + holder.place);
  }
  return map;
}

/// Collective.
PointsOutside points_outside(const mesh::Mesh& mesh, std::span<const double> points,
                             const std::vector<Holder>& holders) {
  PointsOutside result;
  for (std::size_t j = 0; j < holders.size(); ++j) {
    const Holder& holder = holders[j];
    if (holder.rank >= 0 && holder.distance == 0) continue;
    const double cells = holder.rank < 0 ? std::numeric_limits<double>::infinity() : holder.distance / holder.cell_size;
    ++result.count;
    result.distance = std::max(result.distance, holder.rank < 0 ? cells : holder.distance);
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

PointInterpolation::PointInterpolation(const mesh::Mesh& mesh, std::span<const double> points, const std::string& rule)
    : num_points_(points.size() / mesh.dimension) {
  PointSearch search = search_points(mesh, points);
  outside_ = points_outside(mesh, points, search.holders);
  if (outside_.cells > 1) {
    const auto& [x, y, z] = outside_.point;
    throw base::UserError(rule,
                          fmt::format("{} points outside, one of them at ({:.6g}, {:.6g}, {:.6g}) m, further than the "
                                      "longest edge of the nearest cell",
                                      outside_.count, x, y, z),
                          "draw both meshes after the same shape at rest, or make the cells there smaller");
  }
  halo_ = base::Halo(points_as_ghosts(mesh.comm, search));
  held_ = std::move(search.held);
}

void PointInterpolation::evaluate(const fem::Field& field, std::span<double> at_points) const {
  assert(is_on_vertices(*field.space) && at_points.size() == num_points_ * field.components);
  const int n = field.components;
  std::vector<double> values((held_.size() + num_points_) * n, 0.0);
  for (std::size_t i = 0; i < held_.size(); ++i) {
    const auto vertices = field.space->mesh->vertices_of(held_[i].cell);
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      for (int c = 0; c < n; ++c) values[i * n + c] += held_[i].barycentric[k] * field.at(vertices[k])[c];
    }
  }
  halo_.copy_to_ghosts(values, n);
  std::copy(values.end() - static_cast<std::ptrdiff_t>(at_points.size()), values.end(), at_points.begin());
}

void PointInterpolation::restrict_to(std::span<const double> at_points, fem::Load& load) const {
  assert(is_on_vertices(*load.space) && at_points.size() == num_points_ * load.components);
  const int n = load.components;
  std::vector<double> values(held_.size() * n, 0.0);
  values.insert(values.end(), at_points.begin(), at_points.end());
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
