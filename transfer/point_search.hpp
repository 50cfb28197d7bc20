#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::transfer {

/// A point that one of this rank's cells holds, whichever rank has the point.
struct HeldPoint {
  std::int32_t cell = 0;
  std::array<double, 4> barycentric = {0, 0, 0, 0};  ///< the first dimension + 1 count; their sum is 1
};

/// Where a point of this rank is held.
struct Holder {
  int rank = -1;           ///< -1: no cell is as near as the longest edge of all cells
  std::int64_t place = 0;  ///< in that rank's list of held points
  double distance = 0;     ///< [m] from the cell
  double cell_size = 0;    ///< [m] its longest edge
};

struct PointSearch {
  std::vector<HeldPoint> held;  ///< by this rank's cells
  std::vector<Holder> holders;  ///< of this rank's points
};

/// Finds for each point of each rank the cell that contains it, or the nearest one; of several the lowest rank's.
/// Ranks tell each other the boxes around their cells and are asked only for points inside, then for those that nobody
/// had found and that are as near as the longest edge of a cell. Collective.
///
/// points       (points of this rank, dimension) [m]
/// cell_counts  (owned cells of the mesh) not 0 where a cell is to be found; empty: all are
PointSearch search_points(const mesh::Mesh& mesh, std::span<const double> points,
                          std::span<const std::int32_t> cell_counts = {});

}  // namespace vocalis::transfer
