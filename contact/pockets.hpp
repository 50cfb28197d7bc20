#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// Whether each owned cell of the fluid is cut off by contact cells: it is narrow, and no way through facets of narrow
/// cells leads to a wide one. Fluid that is caught between closing walls in so few cells has nowhere to go and no mesh
/// to move in; larger chambers may be closed and stay fluid.
///
/// walls       distance of the fluid's vertices; a cell is narrow where none is farther than `width` of the cell
/// width       (owned cells) [m]
/// in_contact  (owned cells)
/// Collective.
std::vector<char> find_pockets(const WallDistance& walls, std::span<const double> width,
                               std::span<const char> in_contact);

}  // namespace vocalis::contact
