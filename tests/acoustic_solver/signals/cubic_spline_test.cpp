#include "acoustic_solver/signals/cubic_spline.hpp"

#include <catch2/catch.hpp>

using vocalis::acoustic::CubicSpline;

TEST_CASE("a cubic spline gives back a cubic and its derivative, outside of its points, too", "[serial]") {
  const auto cubic = [](double x) { return 1 + x * (2 + x * (-3 + 0.5 * x)); };
  const auto slope = [](double x) { return 2 + x * (-6 + 1.5 * x); };
  const std::vector<double> places = {-1, 0, 0.3, 1, 2.5, 3};
  std::vector<double> values;
  for (const double place : places) values.push_back(cubic(place));
  const CubicSpline spline(places, values);
  for (double x = -1.5; x < 3.5; x += 0.1) {
    CHECK(spline.value(x) == Approx(cubic(x)).margin(1e-12));
    CHECK(spline.rate(x) == Approx(slope(x)).margin(1e-11));
  }
}

TEST_CASE("a cubic spline meets its points with one slope", "[serial]") {
  const std::vector<double> places = {0, 1, 1.5, 4, 5}, values = {0, 3, -1, 2, 2};
  const CubicSpline spline(places, values);
  for (std::size_t i = 1; i + 1 < places.size(); ++i) {
    CHECK(spline.value(places[i]) == Approx(values[i]));
    CHECK(spline.rate(places[i] + 1e-9) == Approx(spline.rate(places[i] - 1e-9)).margin(1e-6));
    const double left = spline.rate(places[i]) - spline.rate(places[i] - 1e-5);
    CHECK(spline.rate(places[i] + 1e-5) - spline.rate(places[i]) == Approx(left).margin(1e-8));
  }
}
