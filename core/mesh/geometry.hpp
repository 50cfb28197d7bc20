#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// Signed area [m^2] of a triangle or volume [m^3] of a tetrahedron given by local vertices.
double signed_volume(const Mesh& mesh, std::span<const std::int32_t> vertices);

/// A facet of a cell: its measure (length [m], area [m^2]) and the unit normal that points out of the cell.
struct FacetGeometry {
  double measure = 0;
  std::array<double, 3> normal = {0, 0, 0};
};
FacetGeometry facet_geometry(const Mesh& mesh, std::int32_t cell, int facet);

/// Local vertices of the facet opposite to vertex `facet` of a cell; the first `dimension` entries count.
std::array<std::int32_t, 3> facet_vertices(const Mesh& mesh, std::int32_t cell, int facet);

/// Quality of a cell, Q = d det(F)^(2/d) / |F|², F maps the regular simplex to the cell: 1 is regular, <= 0 inverted.
/// The inverse of Q in Degirmenci 2018, eq. (2.6).
double quality(const Mesh& mesh, std::int32_t cell);

/// The same with the vertices elsewhere: (vertices, dimension) [m].
double quality(const Mesh& mesh, std::int32_t cell, std::span<const double> coordinates);

/// Smallest quality over all ranks. Collective.
double smallest_quality(const Mesh& mesh);

}  // namespace vocalis::mesh
