#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/fem/space.hpp"

namespace vocalis::contact {

/// Whether each local dof of a P1 space is a corner of a contact cell, on any rank: 1 or 0.
///
/// in_contact  (owned cells)
/// Collective.
std::vector<std::int32_t> contact_corners(const fem::Space& space, std::span<const char> in_contact);

}  // namespace vocalis::contact
