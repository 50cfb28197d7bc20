#pragma once

#include <span>
#include <vector>

namespace vocalis::acoustic {

/// Cubic spline through points whose places increase; value and two derivatives are continuous. Its end slopes are
/// those of the cubics through the four end points (fewer points: the polynomial through all of them). Outside it goes
/// on with the cubics of the end intervals. Source: de Boor 1978, A Practical Guide to Splines, chapter IV.
class CubicSpline {
 public:
  /// At least two points; as many values as places.
  CubicSpline(std::span<const double> places, std::span<const double> values);
  double value(double place) const;  ///< [unit of the values]
  double rate(double place) const;   ///< derivative [unit of the values over that of the places]

 private:
  std::size_t interval(double place) const;

  std::vector<double> places_;
  std::vector<double> values_;
  std::vector<double> slopes_;  // at the points
};

}  // namespace vocalis::acoustic
