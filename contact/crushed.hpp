#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// Whether each owned cell of the fluid that is not in contact has a corner of a contact cell, is narrow as for
/// `find_pockets`, and is thin against its longest edge: it closes before it is crushed.
///
/// coordinates  (vertices, dimension) [m], ghosts current
/// thinnest     d! measure / edge^d, in (0, 1): thinner cells count
/// Collective.
std::vector<char> find_crushed(const WallDistance& walls, std::span<const double> width,
                               std::span<const double> coordinates, std::span<const char> in_contact, double thinnest);

}  // namespace vocalis::contact
