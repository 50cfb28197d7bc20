#include "acoustic_solver/sources/liljencrants_fant.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/error.hpp"

using namespace vocalis::acoustic;

TEST_CASE("the LF pulse has the instants it was asked for and returns to zero", "[serial]") {
  const LiljencrantsFantPulse settings{125, 0.5, 0.65, 0.7, 0.04};
  const LiljencrantsFantFlux flux(settings);
  const double period = 1.0 / 125;
  const double te = 0.65 * period;
  const double tp = 0.7 * te;
  const double ta = 0.04 * period;
  CHECK(flux.rate(tp) == Approx(0).margin(1e-12));
  CHECK(flux.rate(te) == Approx(-0.5).epsilon(1e-9));
  CHECK(flux.rate(te - 1e-12) == Approx(-0.5).epsilon(1e-6));
  // Fant's definition of ta: the tangent of the return at te meets zero ta later.
  CHECK((flux.rate(te + 1e-9) - flux.rate(te)) / 1e-9 == Approx(0.5 / ta).epsilon(0.01));
  CHECK(flux.epsilon() * ta == Approx(1 - std::exp(-flux.epsilon() * (period - te))).epsilon(1e-10));
  CHECK(flux.value(period) == Approx(0).margin(1e-12 * flux.peak()));
  CHECK(flux.value(period * (1 - 1e-12)) == Approx(0).margin(1e-9 * flux.peak()));
  CHECK(flux.value(tp) == Approx(flux.peak()));
  double largest = 0;
  for (int n = 0; n < 4000; ++n) largest = std::max(largest, flux.value(n * period / 4000));
  CHECK(largest == Approx(flux.peak()).epsilon(1e-5));
  CHECK(flux.value(-0.001) == 0);
}

TEST_CASE("the LF flux is the integral of its rate, over open and return phase", "[serial]") {
  for (double open : {0.4, 0.6, 0.8}) {
    for (double asymmetry : {0.6, 0.75, 0.9}) {
      for (double back : {0.005, 0.03, 0.1}) {
        const LiljencrantsFantFlux flux(LiljencrantsFantPulse{100, 0.4, open, asymmetry, back});
        double integral = 0;
        const int count = 20000;
        const double step = 0.01 / count;
        double error = 0;
        for (int n = 0; n < count; ++n) {
          integral += step * flux.rate((n + 0.5) * step);
          error = std::max(error, std::abs(integral - flux.value((n + 1) * step)));
        }
        CHECK(error < 2e-6 * flux.peak() + 1e-9);
        CHECK(std::abs(integral) < 1e-5 * flux.peak());  // the midpoint rule crosses the kink at te
      }
    }
  }
}

TEST_CASE("the LF flux of a male voice is some tenths of a litre per second", "[serial]") {
  const LiljencrantsFantFlux flux(LiljencrantsFantPulse{});
  CHECK(flux.peak() > 2e-4);
  CHECK(flux.peak() < 8e-4);
  CHECK(flux.value(0.0137) == Approx(flux.value(0.0037)));
}

TEST_CASE("impossible LF pulses are refused", "[serial]") {
  using vocalis::base::UserError;
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{0, 0.4, 0.6, 0.75, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 1.2, 0.75, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 0.6, 0.4, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 0.6, 0.75, 0.5}), UserError);
}
