#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::acoustic {

/// A named surface around the sources, as this rank sees it: what of p on the cells along it, on the sources' side (its
/// skin), says p and ∂p/∂n there. Sums of a vertex over the ranks are its whole integrals; each rank has the part of
/// its own facets and cells.
///
/// The flux is consistent, not the gradient in a cell: with n out of the sources' side, φ_v the basis function of a
/// vertex of the surface and integrals over the skin alone, the wave equation says
///   <∂p/∂n, φ_v> = (∇p, ∇φ_v) + (1 / c²) (p̈, φ_v),
/// which is of second order for a finite element solution (as reactions are) where a one-sided gradient is of first.
/// Other boundaries that the skin touches are taken for rigid.
struct ControlSurface {
  std::vector<std::int32_t> skin;             ///< local vertices of the mesh that the skin's cells have
  std::vector<std::int32_t> vertex_in_skin;   ///< (vertices of the surface) place in `skin`
  std::vector<std::array<double, 3>> points;  ///< (vertices of the surface) [m]
  std::vector<std::array<double, 3>> areas;   ///< (vertices of the surface) ∫ n φ_v dS [m^2]
  std::vector<std::int32_t> row_begin;  ///< (vertices of the surface + 1) of the sparse rows of (∇p, ∇φ_v), (p, φ_v)
  std::vector<std::int32_t> columns;  ///< places in `skin`
  std::vector<double> stiffness;      ///< [m]
  std::vector<double> mass;           ///< [m^3]
  double longest_edge = 0;            ///< of the facets of all ranks [m]
};

/// The surface made by a group of facets, at the mesh's present coordinates. A group on the boundary has the mesh on
/// its inner side. A group inside the mesh must part it, and the cells with sources must be on one side of it.
///
/// has_source  (owned cells) not 0: sound is made in it. None need be marked for a group on the boundary.
/// Throws UserError: a plane mesh, no such group, a group without facets, one that does not part the mesh, sources in
/// the skin. Collective.
ControlSurface control_surface(const mesh::Mesh& mesh, const std::string& group,
                               std::span<const std::int32_t> has_source);

}  // namespace vocalis::acoustic
