#pragma once

#include <span>
#include <vector>

#include "core/fem/space.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::contact {

/// The walls of the fluid as a set of facets: intervals in the plane, triangles in space. The same on every rank.
struct Walls {
  int dimension = 2;
  std::vector<double> corners;  ///< (facets, dimension, dimension): corners of each facet, then coordinates [m]

  std::size_t num_facets() const { return corners.size() / (dimension * dimension); }
};

/// A rigid plane of symmetry, x[axis] = position: what lies behind it is the mirror image of what lies before.
struct SymmetryPlane {
  int axis = 1;
  double position = 0;  ///< [m]
};

/// Whether each local vertex lies on the plane, to 1e-9 of the size of the scene. Collective.
///
/// coordinates  (vertices, dimension) [m], ghosts current
std::vector<char> vertices_on_plane(const mesh::Mesh& mesh, std::span<const double> coordinates,
                                    const SymmetryPlane& plane);

/// The facets of fluid cells towards solid ones, and those of fluid cells in the named groups (rigid walls).
///
/// cell_is_fluid  (local cells, ghosts current)
/// wall_groups    indices in Mesh::group_names
std::vector<mesh::NamedFacet> wall_facets(const mesh::Mesh& mesh, std::span<const char> cell_is_fluid,
                                          std::span<const std::int32_t> wall_groups);

/// These facets of all ranks where the vertices are now; with planes of symmetry, their mirror images too.
///
/// coordinates  (vertices, dimension) [m], ghosts current
/// Collective.
Walls gather_walls(const mesh::Mesh& mesh, std::span<const mesh::NamedFacet> facets,
                   std::span<const double> coordinates, std::span<const SymmetryPlane> planes = {});

/// Unit normals of the walls into the fluid at the dofs on them, means over the facets around weighted by their
/// measure; 0 elsewhere. (dofs, dimension), ghosts current.
///
/// space  P1 on the fluid's cells
/// Collective.
std::vector<double> wall_normals(const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                                 std::span<const double> coordinates);

}  // namespace vocalis::contact
