#pragma once

#include <span>
#include <vector>

#include "core/fem/space.hpp"

namespace vocalis::coupling {

/// Places on a fold: the middles of equal parts of an interval.
struct Stations {
  int axis = 0;               ///< 0, 1, 2 = x, y, z: along which they stand
  double begin = 0, end = 0;  ///< [m] of the interval
  int count = 1;

  double step() const { return (end - begin) / count; }
  double place(int i) const { return begin + (i + 0.5) * step(); }
};

/// A grid over a fold, seen across the glottis. It stands still while the fold moves.
struct FoldGrid {
  Stations along;       ///< the way of the flow
  int across = 1;       ///< the axis along which the glottis opens
  Stations span = {2};  ///< the third axis; in the plane it has one place, and a step that does not count

  std::size_t size() const { return static_cast<std::size_t>(along.count) * span.count; }
};

/// One side of a glottis over its grid.
struct FoldProfile {
  std::vector<double> nearest;  ///< (along, span) [m] coordinate `across`; infinite where no facet is
  std::vector<char> is_sealed;  ///< (along, span) the facet there touches a contact cell
};

/// Where the facets of a fold are over the grid: of several, those that are nearest to what lies on their other side.
/// Facets of degree 2 are taken as two (in space four) straight ones through their nodes.
///
/// points      (dofs, dimension) [m] where the dofs of the space are now
/// facets      as seen from the fluid
/// side        +1: the fold lies on the side of large coordinates, its lowest point counts; -1: the other way
/// in_contact  (owned cells), or empty: none
/// Collective; the same on every rank.
FoldProfile fold_profile(const fem::Space& space, std::span<const double> points,
                         const std::vector<mesh::NamedFacet>& facets, const FoldGrid& grid, int side,
                         std::span<const char> in_contact);

}  // namespace vocalis::coupling
