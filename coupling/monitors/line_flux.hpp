#pragma once

#include <span>
#include <vector>

#include "core/fem/cell_map.hpp"

namespace vocalis::coupling {

/// ∫ v·n ds [m^2/s] along the part of a line that lies in the marked cells of a plane mesh, n to the right of the way
/// from `from` to `to`. Collective.
///
/// Each cell takes its part of the line as if it were straight between its corners; three Gauss points there, found in
/// the curved cell, are exact for velocities of degree 2 on straight cells. Where the line runs along a facet, the
/// cells on its sides share it.
///
/// points          (dofs, 2) [m] where the dofs of the velocity's space are now
/// cell_is_marked  of local cells, ghosts too
double flux_across(const fem::Field& velocity, std::span<const double> points, const fem::Point& from,
                   const fem::Point& to, const std::vector<std::int32_t>& cell_is_marked);

}  // namespace vocalis::coupling
