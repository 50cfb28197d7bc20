#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// How wide the gap between two walls is in the cells of its medial axis, where two walls are equally near: there |∇D|,
/// the length of the mean of the directions away from both, is at most γ.
struct AxisGap {
  std::vector<double> gap;     ///< (owned cells) [m] from wall to wall; infinite off the axis
  std::vector<double> normal;  ///< (owned cells, dimension) unit vector across the gap, 0 off the axis
};

/// A cell is on the axis if |∇D| <= γ at one of its corners, or for the mean of two of them: an axis along facets
/// leaves each cell a slope of one. With γ < 1 the bisector of a wedge counts if half its angle is at most arcsin γ,
/// and no cell in a corner of one wall does. A plane of symmetry is an axis where the wall's angle with it is at most
/// arcsin γ. No corner beyond the bound of the distance counts. For two of its corners, of which each is nearer to one
/// of the walls,
///
///   gap = D_a + D_b + |n·(x_a - x_b)|,   n = (∇D_a - ∇D_b) / |∇D_a - ∇D_b|,
///
/// which is exact between parallel walls, with one cell or many between them; the smallest over such pairs counts. A
/// single corner with a short direction, as on a plane of symmetry, has gap = 2 D; n is then across the cell's steepest
/// direction.
///
/// coordinates  (vertices, dimension) [m], ghosts current
/// Not collective.
/// Source: Degirmenci 2018, Algorithm 2, step 3, for the criterion.
AxisGap axis_gap(const WallDistance& walls, std::span<const double> coordinates, double gamma);

}  // namespace vocalis::contact
