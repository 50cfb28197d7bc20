#include "acoustic_solver/sources/rosenberg.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

using namespace vocalis::acoustic;

namespace {
const RosenbergPulse modal{
    .fundamental_frequency = 100, .amplitude = 0.5, .open_quotient = 0.56, .speed_quotient = 2.5};
}

TEST_CASE("Rosenberg's pulse opens for 0.40 and closes for 0.16 of its period", "[serial]") {
  const RosenbergFlux flux(modal);
  CHECK(flux.value(-1e-3) == 0);
  CHECK(flux.value(0.002) == Approx(0.25));
  CHECK(flux.value(0.004) == Approx(0.5));
  CHECK(flux.rate(0.004) == Approx(0).margin(1e-9));
  CHECK(flux.value(0.0048) == Approx(0.5 * std::sqrt(0.5)));
  CHECK(flux.value(0.0056) == Approx(0).margin(1e-12));
  CHECK(flux.rate(0.0056 - 1e-9) == Approx(-std::numbers::pi * 0.5 / (2 * 0.0016)));
  CHECK(flux.rate(0.0056 + 1e-9) == 0);
  CHECK(flux.value(0.009) == 0);
  CHECK(flux.value(0.0137) == Approx(flux.value(0.0037)));
}

TEST_CASE("Rosenberg's flux is continuous and the integral of its rate", "[serial]") {
  for (const double open : {0.3, 0.56, 1.0}) {
    for (const double speed : {0.5, 1.0, 4.0}) {
      const RosenbergFlux flux({.fundamental_frequency = 125, .open_quotient = open, .speed_quotient = speed});
      const int count = 20000;
      const double step = 0.016 / count;
      double integral = 0, error = 0;
      for (int n = 0; n < count; ++n) {
        integral += step * flux.rate((n + 0.5) * step);
        error = std::max(error, std::abs(integral - flux.value((n + 1) * step)));
      }
      CHECK(error < 1e-3);  // the midpoint rule crosses the kink at closure: half a step of the rate there
    }
  }
}

TEST_CASE("impossible pulses of Rosenberg are refused", "[serial]") {
  using vocalis::base::UserError;
  CHECK_THROWS_AS(RosenbergFlux({.fundamental_frequency = 0}), UserError);
  CHECK_THROWS_AS(RosenbergFlux({.amplitude = 0}), UserError);
  CHECK_THROWS_AS(RosenbergFlux({.open_quotient = 1.1}), UserError);
  CHECK_THROWS_AS(RosenbergFlux({.speed_quotient = -1}), UserError);
}
