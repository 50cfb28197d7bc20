#pragma once

#include <span>
#include <vector>

#include "contact/eikonal.hpp"
#include "contact/walls.hpp"
#include "core/fem/field.hpp"

namespace vocalis::contact {

/// How far the walls are from each vertex of the fluid, and which way they are.
struct WallDistance {
  fem::Field distance;            ///< D [m], P1 on the fluid's cells, 0 on the walls; ghosts current
  std::vector<double> direction;  ///< (dofs, dimension) ∇D: away from the nearest wall, on a wall its normal; ghosts
                                  ///< current. Exact ones have length one, those of the PDE less near a medial axis
};

/// From the walls themselves, gathered on every rank: exact. Where a vertex has several nearest facets, one direction
/// of them.
///
/// space        P1 on the fluid's cells
/// facets       from `wall_facets`
/// coordinates  (vertices, dimension) [m], ghosts current
/// bound        beyond this the distance is `bound` and the direction 0: what is far needs no search [m]
/// Collective.
WallDistance direct_distance(const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                             std::span<const double> coordinates, std::span<const SymmetryPlane> planes, double bound);

/// From the Eikonal equation, beginning with `guess` [m] (empty: none). On a plane of symmetry D has no slope.
/// Collective.
WallDistance eikonal_distance(Eikonal& eikonal, const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                              std::span<const double> coordinates, const EikonalSettings& settings,
                              std::span<const double> guess, EikonalReport& report);

}  // namespace vocalis::contact
