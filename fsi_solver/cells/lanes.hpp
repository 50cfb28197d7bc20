#pragma once

#include <cmath>

namespace vocalis::fsi {

/// Cells that are computed side by side.
inline constexpr int lane_count = 8;

/// One number of each of them; the compiler makes vector instructions of its arithmetic.
using Lanes = double __attribute__((vector_size(lane_count * sizeof(double))));

template <class Function>
Lanes each_lane(const Lanes& a, const Function& function) {
  Lanes result;
  for (int lane = 0; lane < lane_count; ++lane) result[lane] = function(a[lane]);
  return result;
}

inline double logarithm(double a) { return std::log(a); }
inline Lanes logarithm(const Lanes& a) {
  return each_lane(a, [](double x) { return std::log(x); });
}
inline Lanes square_root(const Lanes& a) {
  return each_lane(a, [](double x) { return std::sqrt(x); });
}
inline Lanes absolute(const Lanes& a) { return a < 0 ? -a : a; }
inline Lanes smaller(const Lanes& a, const Lanes& b) { return a < b ? a : b; }

inline double sum(const Lanes& a) {
  double result = 0;
  for (int lane = 0; lane < lane_count; ++lane) result += a[lane];
  return result;
}

}  // namespace vocalis::fsi
