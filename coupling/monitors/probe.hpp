#pragma once

#include <span>
#include <vector>

#include "core/fem/cell_map.hpp"

namespace vocalis::coupling {

/// A point of the reference configuration: the cell that has it, and where it is in that cell's isoparametric map.
struct Probe {
  int rank = -1;           ///< that has the cell, the same on every rank; -1: no cell contains the point
  std::int32_t cell = -1;  ///< on that rank, and so are ...
  fem::Barycentric coordinates = {0, 0, 0, 0};
};

/// Looks for a point in the marked cells, with the dofs of the space at given points of the reference. A point on a
/// curved boundary may be outside of all cells: less than a tenth of a cell is forgiven. Of several cells it is the one
/// where the point lies deepest, then that of the lowest rank. Collective.
Probe find_probe(const fem::Space& space, std::span<const double> points, const fem::Point& position,
                 const std::vector<std::int32_t>& cell_is_marked);

/// All components of a field at a probe, the same on every rank. Its space must have unknowns there. Collective.
std::vector<double> value_at(const fem::Field& field, const Probe& probe);

}  // namespace vocalis::coupling
