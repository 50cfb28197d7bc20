#pragma once

#include <cstdint>
#include <vector>

namespace vocalis::io {

/// For each wanted point the row of the one point that lies within a distance of it; -1 where none or several do.
///
/// points, wanted  (rows, dimension) [m]
/// One rank, not collective.
std::vector<std::int64_t> match_points(const std::vector<double>& points, const std::vector<double>& wanted,
                                       int dimension, double distance);

}  // namespace vocalis::io
