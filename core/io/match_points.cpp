#include "core/io/match_points.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::io {

namespace {

/// Of which few points of a mesh, structured ones included, have the same.
double key_of(const double* point, int dimension) {
  const double in_plane = 0.60546 * point[0] + 0.69315 * point[1];
  return dimension == 2 ? in_plane : in_plane + 0.39113 * point[2];
}

}  // namespace

std::vector<std::int64_t> match_points(const std::vector<double>& points, const std::vector<double>& wanted,
                                       int dimension, double distance) {
  std::vector<std::pair<double, std::int64_t>> keys;
  for (std::size_t row = 0; row * dimension < points.size(); ++row) {
    keys.emplace_back(key_of(points.data() + row * dimension, dimension), static_cast<std::int64_t>(row));
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::int64_t> rows;
  for (std::size_t at = 0; at < wanted.size(); at += dimension) {
    const double key = key_of(wanted.data() + at, dimension), reach = 1.01 * distance;
    std::int64_t found = -1, count = 0;
    auto candidate = std::lower_bound(keys.begin(), keys.end(), std::pair(key - reach, std::int64_t{0}));
    for (; candidate != keys.end() && candidate->first <= key + reach; ++candidate) {
      double square = 0;
      for (int k = 0; k < dimension; ++k) {
        square += std::pow(points[candidate->second * dimension + k] - wanted[at + k], 2);
      }
      if (square > distance * distance) continue;
      found = candidate->second;
      ++count;
    }
    rows.push_back(count == 1 ? found : -1);
  }
  return rows;
}

}  // namespace vocalis::io
