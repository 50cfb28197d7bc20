#include "core/mesh/generate.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::mesh {

namespace {

struct Grid {
  int dimension;
  std::array<std::int64_t, 3> points;

  std::int64_t vertex(const std::array<std::int64_t, 3>& i) const {
    return i[0] + points[0] * (i[1] + points[1] * i[2]);
  }
};

/// The paths from the lowest corner of a brick to the highest, one axis at a time (Kuhn's subdivision).
void add_brick(WholeMesh& mesh, const Grid& grid, const std::array<std::int64_t, 3>& corner) {
  std::array<int, 3> axes = {0, 1, 2};
  do {
    std::array<std::int64_t, 3> at = corner;
    mesh.cell_vertices.push_back(grid.vertex(at));
    for (int i = 0; i < grid.dimension; ++i) {
      ++at[axes[i]];
      mesh.cell_vertices.push_back(grid.vertex(at));
    }
    mesh.cell_region.push_back(0);
  } while (std::next_permutation(axes.begin(), axes.begin() + grid.dimension));
}

/// Names the facets of the last brick's cells that lie on the side `axis` = 0 or its far end.
void add_side_facets(WholeMesh& mesh, const Grid& grid) {
  const int d = grid.dimension;
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int64_t* vertices = mesh.cell_vertices.data() + cell * (d + 1);
    for (int opposite = 0; opposite <= d; ++opposite) {
      for (int axis = 0; axis < d; ++axis) {
        std::int64_t stride = axis == 0 ? 1 : (axis == 1 ? grid.points[0] : grid.points[0] * grid.points[1]);
        std::array<int, 2> on_side = {0, 0};
        for (int i = 0; i <= d; ++i) {
          const std::int64_t position = (vertices[i] / stride) % grid.points[axis];
          if (i == opposite) continue;
          on_side[0] += position == 0;
          on_side[1] += position == grid.points[axis] - 1;
        }
        for (int side = 0; side < 2; ++side) {
          if (on_side[side] != d) continue;
          for (int i = 0; i <= d; ++i) {
            if (i != opposite) mesh.facet_vertices.push_back(vertices[i]);
          }
          mesh.facet_group.push_back(2 * axis + side);
        }
      }
    }
  }
}

}  // namespace

WholeMesh box(MPI_Comm comm, std::array<double, 3> size, std::array<int, 3> cells) {
  WholeMesh mesh;
  mesh.dimension = size[2] > 0 ? 3 : 2;
  mesh.region_names = {"box"};
  mesh.group_names = {"left", "right", "bottom", "top", "front", "back"};
  mesh.group_names.resize(2 * mesh.dimension);
  if (base::rank(comm) != 0) return mesh;
  if (mesh.dimension == 2) cells[2] = 0;
  const Grid grid = {mesh.dimension, {cells[0] + 1, cells[1] + 1, cells[2] + 1}};
  for (std::int64_t k = 0; k < grid.points[2]; ++k) {
    for (std::int64_t j = 0; j < grid.points[1]; ++j) {
      for (std::int64_t i = 0; i < grid.points[0]; ++i) {
        const std::array<std::int64_t, 3> index = {i, j, k};
        for (int axis = 0; axis < mesh.dimension; ++axis) {
          mesh.coordinates.push_back(size[axis] * static_cast<double>(index[axis]) / cells[axis]);
        }
      }
    }
  }
  for (std::int64_t k = 0; k < std::max(cells[2], 1); ++k) {
    for (std::int64_t j = 0; j < cells[1]; ++j) {
      for (std::int64_t i = 0; i < cells[0]; ++i) add_brick(mesh, grid, {i, j, k});
    }
  }
  add_side_facets(mesh, grid);
  return mesh;
}

}  // namespace vocalis::mesh
