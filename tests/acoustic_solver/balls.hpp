#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::acoustic::test {

/// A ball about the origin, or its half z > 0: a cube of cells whose layers are bent to spheres. Groups: "open", the
/// sphere; "control", the sphere of half the radius inside of it; of the half ball "baffle" at z = 0, and in it
/// "piston", a disc (with corners at cells) of a quarter of the radius.
///
/// cells  across the diameter, a multiple of 4, of 8 for a piston. Collective.
inline mesh::Mesh ball(double radius, int cells, bool is_half = false) {
  mesh::WholeMesh whole =
      mesh::box(MPI_COMM_WORLD, {2, 2, is_half ? 1.0 : 2.0}, {cells, cells, is_half ? cells / 2 : cells});
  for (std::size_t i = 0; i < whole.coordinates.size(); ++i) {
    if (!is_half || i % 3 < 2) whole.coordinates[i] -= 1;
  }
  /// Whether three vertices are on one face of the cube of half the edge `size`, or on the plane z = 0.
  const auto on_face = [&](const std::int64_t* corners, int axis, double where) {
    return std::all_of(corners, corners + 3,
                       [&](auto v) { return std::abs(whole.coordinates[3 * v + axis] - where) < 1e-9; });
  };
  const auto on_cube = [&](const std::int64_t* corners, double size) {
    for (int axis = 0; axis < 3; ++axis) {
      if (on_face(corners, axis, size) || on_face(corners, axis, -size)) return true;
    }
    return false;
  };
  const auto is_within = [&](const std::int64_t* corners, double size) {
    return std::all_of(corners, corners + 3, [&](auto v) {
      const double* x = whole.coordinates.data() + 3 * v;
      return std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])}) < size + 1e-9;
    });
  };
  whole.group_names = {"open", "control", "baffle", "piston"};
  for (std::size_t f = 0; f < whole.facet_group.size(); ++f) {
    const std::int64_t* corners = whole.facet_vertices.data() + 3 * f;
    whole.facet_group[f] = on_cube(corners, 1) ? 0 : is_within(corners, 0.25) ? 3 : 2;
  }
  std::set<std::array<std::int64_t, 3>> seen;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    for (int opposite = 0; opposite < 4; ++opposite) {
      std::array<std::int64_t, 3> facet;
      for (int i = 0, n = 0; i < 4; ++i) {
        if (i != opposite) facet[n++] = whole.cell_vertices[4 * cell + i];
      }
      std::sort(facet.begin(), facet.end());
      const bool is_control = on_cube(facet.data(), 0.5) && is_within(facet.data(), 0.5);
      if (!is_control || !seen.insert(facet).second) continue;
      whole.facet_vertices.insert(whole.facet_vertices.end(), facet.begin(), facet.end());
      whole.facet_group.push_back(1);
    }
  }
  for (std::size_t i = 0; i < whole.coordinates.size(); i += 3) {
    double* x = whole.coordinates.data() + i;
    const double length = std::hypot(x[0], x[1], x[2]);
    const double largest = std::max({std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
    for (int k = 0; k < 3 && length > 0; ++k) x[k] *= radius * largest / length;
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

}  // namespace vocalis::acoustic::test
