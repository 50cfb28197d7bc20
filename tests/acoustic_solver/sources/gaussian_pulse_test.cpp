#include "acoustic_solver/sources/gaussian_pulse.hpp"

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

TEST_CASE("impossible Gaussian pulses are refused", "[serial]") {
  using vocalis::base::UserError;
  CHECK_THROWS_AS(GaussianFlux(GaussianPulse{0, 1000}), UserError);
  CHECK_THROWS_AS(GaussianFlux(GaussianPulse{1, -1000}), UserError);
}
