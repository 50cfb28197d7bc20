#include "acoustic_solver/pulse.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

using namespace vocalis::acoustic;

TEST_CASE("the Gaussian pulse starts smoothly and its spectrum falls by 20 dB at its highest frequency", "[serial]") {
  const GaussianFlux flux(GaussianPulse{2e-4, 8000});
  CHECK(flux.value(0) < 2e-8 * 2e-4);
  CHECK(flux.value(flux.delay()) == Approx(2e-4));
  CHECK(flux.value(flux.end()) < 2e-8 * 2e-4);
  CHECK(std::abs(flux.spectrum(8000)) / std::abs(flux.spectrum(0)) == Approx(0.1));
}

TEST_CASE("derivative and spectrum of the Gaussian pulse are those of its values", "[serial]") {
  const GaussianFlux flux(GaussianPulse{1, 5000});
  const double step = 1e-7;
  for (double time : {1e-4, 3e-4, 4e-4, 5e-4}) {
    const double difference = (flux.value(time + step) - flux.value(time - step)) / (2 * step);
    CHECK(flux.rate(time) == Approx(difference).epsilon(1e-5).margin(1e-6));
  }
  for (double frequency : {0.0, 1000.0, 4000.0}) {
    std::complex<double> sum = 0;  // trapezoidal rule: spectrally accurate for a Gaussian
    for (int n = 0; n * 2e-6 < flux.end(); ++n) {
      const double time = n * 2e-6;
      sum += flux.value(time) * std::polar(2e-6, -2 * std::numbers::pi * frequency * time);
    }
    CHECK(std::abs(sum - flux.spectrum(frequency)) < 1e-7 * flux.width());
  }
}

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

TEST_CASE("a pulse flux is whichever kind was set", "[serial]") {
  const PulseFlux gaussian(GaussianPulse{1e-4, 10000});
  const GaussianFlux same(GaussianPulse{1e-4, 10000});
  CHECK(gaussian.value(2e-4) == same.value(2e-4));
  CHECK(gaussian.rate(1e-4) == same.rate(1e-4));
  const PulseFlux voiced(LiljencrantsFantPulse{});
  CHECK(voiced.rate(0.006) == Approx(-0.4));
}

TEST_CASE("impossible pulses are refused", "[serial]") {
  using vocalis::base::UserError;
  CHECK_THROWS_AS(GaussianFlux(GaussianPulse{0, 1000}), UserError);
  CHECK_THROWS_AS(GaussianFlux(GaussianPulse{1, -1000}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{0, 0.4, 0.6, 0.75, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 1.2, 0.75, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 0.6, 0.4, 0.03}), UserError);
  CHECK_THROWS_AS(LiljencrantsFantFlux(LiljencrantsFantPulse{100, 0.4, 0.6, 0.75, 0.5}), UserError);
}
