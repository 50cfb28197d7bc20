#pragma once

#include <limits>
#include <span>
#include <vector>

#include "contact/eikonal.hpp"
#include "contact/walls.hpp"
#include "core/fem/field.hpp"

namespace vocalis::contact {

/// How far the walls are from each vertex of the fluid, and which way they are.
///
/// On a plane of symmetry two mirrored walls are equally near: there the direction is the mean of both, which has no
/// component across the plane; its length is the sine of the wall's angle with the plane.
struct WallDistance {
  fem::Field distance;            ///< D [m], P1 on the fluid's cells, 0 on the walls; ghosts current
  std::vector<double> direction;  ///< (dofs, dimension) ∇D: away from the nearest wall, on a wall its normal; ghosts
                                  ///< current. Exact ones have length one, those of the PDE less on a medial axis
  double bound = std::numeric_limits<double>::infinity();  ///< what is not nearer has D = bound, direction 0 [m]
};

/// From the walls themselves, gathered on every rank: exact. Where a vertex has several nearest points on them, the
/// direction from one, but on planes of symmetry.
///
/// space        P1 on the fluid's cells
/// facets       from `wall_facets`
/// coordinates  (vertices, dimension) [m], ghosts current
/// bound        what is far needs no search [m]
/// Collective.
WallDistance direct_distance(const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                             std::span<const double> coordinates, std::span<const SymmetryPlane> planes, double bound);

/// From the Eikonal equation, beginning with `guess` [m] (empty: none).
/// Collective.
WallDistance eikonal_distance(Eikonal& eikonal, const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                              std::span<const double> coordinates, std::span<const SymmetryPlane> planes,
                              const EikonalSettings& settings, std::span<const double> guess, EikonalReport& report);

}  // namespace vocalis::contact
