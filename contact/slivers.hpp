#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// Whether each owned cell of the fluid that is not in contact has all of its corners on walls or contact cells, at
/// least one of them off the walls: between a contact cell and the wall beside it, no motion of the mesh can keep it
/// from being crushed. Where one cell reaches from wall to wall there is none.
///
/// walls       distance of the fluid's vertices
/// in_contact  (owned cells)
/// Collective.
std::vector<char> find_slivers(const WallDistance& walls, std::span<const char> in_contact);

}  // namespace vocalis::contact
