#include "acoustic_solver/six_points.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace vocalis::acoustic {

TEST_CASE("six points give a polynomial of degree five, at any nodes and by powers", "[serial]") {
  const auto polynomial = [](double x) { return 1 + x * (2 + x * (-1 + x * (0.5 + x * (0.2 - 0.3 * x)))); };
  const std::array<double, six> uneven = {-2.5, -1, 0, 0.3, 2, 2.8}, even = {-2, -1, 0, 1, 2, 3};
  for (const double x : {-0.7, 0.0, 0.25, 1.0, 2.9}) {
    const auto weights = six_point_weights(uneven, x), other = six_point_weights(even, x);
    double value = 0, by_powers = 0;
    for (int i = 0; i < six; ++i) {
      value += weights[i] * polynomial(uneven[i]);
      double weight = 0;
      for (int power = 0; power < six; ++power) weight += six_point_powers()[i][power] * std::pow(x, power);
      by_powers += weight * polynomial(even[i]);
      CHECK(weight == Approx(other[i]).margin(1e-12));
    }
    CHECK(value == Approx(polynomial(x)));
    CHECK(by_powers == Approx(polynomial(x)));
  }
}

}  // namespace vocalis::acoustic
