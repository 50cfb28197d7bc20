#include "acoustic_solver/signals/cubic_spline.hpp"

#include <algorithm>
#include <cassert>

namespace vocalis::acoustic {

namespace {

/// Slope at x[0] of the polynomial through the given points (Lagrange).
double end_slope(std::span<const double> x, std::span<const double> y) {
  double slope = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    double weight = 1 / (x[i] - x[0]);
    for (std::size_t j = 1; j < x.size(); ++j) {
      if (j != i) weight *= (x[0] - x[j]) / (x[i] - x[j]);
    }
    slope += weight * (y[i] - y[0]);
  }
  return slope;
}

/// Slopes of the spline at its points: continuity of the second derivative, solved by the Thomas algorithm.
std::vector<double> spline_slopes(std::span<const double> x, std::span<const double> y) {
  const std::size_t count = x.size();
  const std::size_t few = std::min<std::size_t>(4, count);
  std::vector<double> x_back(x.rbegin(), x.rbegin() + static_cast<std::ptrdiff_t>(few));
  std::vector<double> y_back(y.rbegin(), y.rbegin() + static_cast<std::ptrdiff_t>(few));
  std::vector<double> slope(count);
  std::vector<double> upper(count, 0.0);
  slope[0] = end_slope(x.first(few), y.first(few));
  for (std::size_t i = 1; i + 1 < count; ++i) {
    const double left = x[i] - x[i - 1];
    const double right = x[i + 1] - x[i];
    const double load = 3 * ((y[i] - y[i - 1]) / left * right + (y[i + 1] - y[i]) / right * left);
    const double pivot = 2 * (left + right) - right * upper[i - 1];
    upper[i] = left / pivot;
    slope[i] = (load - right * slope[i - 1]) / pivot;
  }
  slope[count - 1] = end_slope(x_back, y_back);
  for (std::size_t i = count - 1; i-- > 1;) slope[i] -= upper[i] * slope[i + 1];
  return slope;
}

}  // namespace

CubicSpline::CubicSpline(std::span<const double> places, std::span<const double> values)
    : places_(places.begin(), places.end()), values_(values.begin(), values.end()) {
  assert(places.size() >= 2 && places.size() == values.size());
  slopes_ = spline_slopes(places, values);
}

std::size_t CubicSpline::interval(double place) const {
  const auto after = std::upper_bound(places_.begin(), places_.end(), place) - places_.begin();
  return static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after - 1, 0, std::ssize(places_) - 2));
}

double CubicSpline::value(double place) const {
  const std::size_t i = interval(place);
  const double width = places_[i + 1] - places_[i], s = (place - places_[i]) / width;
  // Cubic Hermite polynomial of the interval.
  return (1 + 2 * s) * (1 - s) * (1 - s) * values_[i] + s * (1 - s) * (1 - s) * width * slopes_[i] +
         s * s * (3 - 2 * s) * values_[i + 1] - s * s * (1 - s) * width * slopes_[i + 1];
}

double CubicSpline::rate(double place) const {
  const std::size_t i = interval(place);
  const double width = places_[i + 1] - places_[i], s = (place - places_[i]) / width;
  return 6 * s * (1 - s) * (values_[i + 1] - values_[i]) / width + (1 - s) * (1 - 3 * s) * slopes_[i] +
         s * (3 * s - 2) * slopes_[i + 1];
}

}  // namespace vocalis::acoustic
