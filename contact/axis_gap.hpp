#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// How wide the gap between two walls is in the cells of its medial axis.
struct AxisGap {
  std::vector<double> gap;     ///< (owned cells) [m] from wall to wall; infinite off the axis
  std::vector<double> normal;  ///< (owned cells, dimension) unit vector across the gap, 0 off the axis
};

/// A cell is on the axis as `medial_axis` has it. For two of its corners, of which each is nearer to one of the walls,
///
///   gap = D_a + D_b + |n·(x_a - x_b)|,   n = (∇D_a - ∇D_b) / |∇D_a - ∇D_b|,
///
/// which is exact between parallel walls, with one cell or many between them; the smallest over such pairs counts. A
/// single corner with a short direction, as on a plane of symmetry, has gap = 2 D; n is then across the cell's steepest
/// direction.
///
/// coordinates  (vertices, dimension) [m], ghosts current
/// Not collective.
AxisGap axis_gap(const WallDistance& walls, std::span<const double> coordinates, double gamma);

}  // namespace vocalis::contact
