#include "contact/walls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "core/base/mpi.hpp"

namespace vocalis::contact {

namespace {

/// Normal of a facet into its cell with the length of its measure.
std::array<double, 3> weighted_normal(const mesh::Mesh& mesh, const mesh::NamedFacet& facet,
                                      std::span<const double> coordinates) {
  const int d = mesh.dimension;
  const auto vertices = mesh.vertices_of(facet.cell);
  const auto point = [&](int i) { return coordinates.data() + static_cast<std::size_t>(vertices[i]) * d; };
  std::array<const double*, 3> corner = {nullptr, nullptr, nullptr};
  for (int i = 0, n = 0; i <= d; ++i) {
    if (i != facet.index) corner[n++] = point(i);
  }
  std::array<double, 3> normal = {0, 0, 0};
  if (d == 2) {
    normal = {corner[0][1] - corner[1][1], corner[1][0] - corner[0][0], 0};
  } else {
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      normal[k] = 0.5 * ((corner[1][a] - corner[0][a]) * (corner[2][b] - corner[0][b]) -
                         (corner[1][b] - corner[0][b]) * (corner[2][a] - corner[0][a]));
    }
  }
  double inside = 0;
  for (int k = 0; k < d; ++k) inside += normal[k] * (point(facet.index)[k] - corner[0][k]);
  if (inside < 0) {
    for (double& value : normal) value = -value;
  }
  return normal;
}

void normalise(double* vector, int dimension) {
  const double length = std::sqrt(std::inner_product(vector, vector + dimension, vector, 0.0));
  for (int k = 0; k < dimension && length > 0; ++k) vector[k] /= length;
}

void add_mirror_images(Walls& walls, const SymmetryPlane& plane) {
  const std::size_t count = walls.corners.size();
  for (std::size_t i = 0; i < count; ++i) {
    const bool across = static_cast<int>(i % walls.dimension) == plane.axis;
    walls.corners.push_back(across ? 2 * plane.position - walls.corners[i] : walls.corners[i]);
  }
}

}  // namespace

std::vector<char> vertices_on_plane(const mesh::Mesh& mesh, std::span<const double> coordinates,
                                    const SymmetryPlane& plane) {
  double size = 0;
  for (const double value : coordinates) size = std::max(size, std::abs(value));
  const double tolerance = 1e-9 * base::largest(mesh.comm, size);
  std::vector<char> marks(mesh.num_vertices());
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double place = coordinates[static_cast<std::size_t>(v) * mesh.dimension + plane.axis];
    marks[v] = std::abs(place - plane.position) <= tolerance;
  }
  return marks;
}

std::vector<mesh::NamedFacet> wall_facets(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid,
                                          std::span<const std::int32_t> wall_groups) {
  const int corners = mesh.dimension + 1;
  std::vector<char> is_wall(mesh.cell_neighbours.size(), 0);
  for (std::size_t f = 0; f < is_wall.size(); ++f) {
    const std::int32_t neighbour = mesh.cell_neighbours[f];
    is_wall[f] = neighbour >= 0 && !cell_is_fluid[neighbour];
  }
  for (const mesh::NamedFacet& facet : mesh.named_facets) {
    if (std::find(wall_groups.begin(), wall_groups.end(), facet.group) == wall_groups.end()) continue;
    is_wall[static_cast<std::size_t>(facet.cell) * corners + facet.index] = 1;
  }
  std::vector<mesh::NamedFacet> facets;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (int index = 0; cell_is_fluid[cell] && index < corners; ++index) {
      if (is_wall[static_cast<std::size_t>(cell) * corners + index]) facets.push_back({cell, index, -1});
    }
  }
  return facets;
}

Walls gather_walls(const mesh::Mesh& mesh, std::span<const mesh::NamedFacet> facets,
                   std::span<const double> coordinates, std::span<const SymmetryPlane> planes) {
  const int d = mesh.dimension;
  std::vector<double> mine;
  for (const mesh::NamedFacet& facet : facets) {
    const auto vertices = mesh.vertices_of(facet.cell);
    for (int i = 0; i <= d; ++i) {
      const double* corner = coordinates.data() + static_cast<std::size_t>(vertices[i]) * d;
      if (i != facet.index) mine.insert(mine.end(), corner, corner + d);
    }
  }
  Walls walls{d, base::concatenate_all(mesh.comm, mine)};
  for (const SymmetryPlane& plane : planes) add_mirror_images(walls, plane);
  return walls;
}

std::vector<double> wall_normals(const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                                 std::span<const double> coordinates) {
  const mesh::Mesh& mesh = *space.mesh;
  const int d = mesh.dimension;
  std::vector<double> normals(static_cast<std::size_t>(space.num_dofs()) * d, 0.0);
  for (const mesh::NamedFacet& facet : facets) {
    const std::array<double, 3> normal = weighted_normal(mesh, facet, coordinates);
    const auto dofs = space.dofs_of(facet.cell);
    for (int i = 0; i <= d; ++i) {
      for (int k = 0; k < d && i != facet.index; ++k) {
        normals[static_cast<std::size_t>(dofs[i]) * d + k] += normal[k];
      }
    }
  }
  space.halo.add_to_owners(normals, d);
  space.halo.copy_to_ghosts(normals, d);
  for (std::size_t i = 0; i < normals.size(); i += d) normalise(normals.data() + i, d);
  return normals;
}

}  // namespace vocalis::contact
