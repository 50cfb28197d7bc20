#include "acoustic_solver/signals/driven_response.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/sources/liljencrants_fant.hpp"
#include "tests/acoustic_solver/signals/synthetic_vowel.hpp"

using vocalis::acoustic::driven_response;
using vocalis::acoustic::LiljencrantsFantFlux;

namespace {

/// Response of damped resonators in parallel to a source, both at 40 kHz.
std::vector<double> resonate(const std::vector<double>& source, const std::vector<double>& frequencies,
                             double bandwidth) {
  constexpr double rate = 40000;
  std::vector<double> result(source.size(), 0.0);
  for (const double frequency : frequencies) {
    const double radius = std::exp(-std::numbers::pi * bandwidth / rate);
    const double a1 = 2 * radius * std::cos(2 * std::numbers::pi * frequency / rate), a2 = -radius * radius;
    double y1 = 0, y2 = 0;
    for (std::size_t n = 0; n < source.size(); ++n) {
      const double y = a1 * y1 + a2 * y2 + source[n];
      y2 = y1;
      y1 = y;
      result[n] += y;
    }
  }
  return result;
}

}  // namespace

TEST_CASE("resonances are found between the harmonics of a growing voice", "[serial]") {
  // A source of 154 Hz that grows, whose harmonics fall by 18 dB an octave and leave 388 Hz out, with weak noise on
  // top.
  std::vector<double> source;
  unsigned noise = 1;
  for (int n = 0; n < 2400; ++n) {
    const double t = n / 40000.0;
    double value = 0;
    for (int k = 1; k < 12; ++k) value += std::sin(2 * std::numbers::pi * 154 * k * t) / (k * k * k);
    noise = noise * 1664525u + 1013904223u;
    source.push_back(value * std::exp(20 * t) + 1e-4 * (noise / 4294967296.0 - 0.5));
  }
  const std::vector<double> formants = {388, 2540, 3680};
  const auto found = driven_response(source, resonate(source, formants, 15), 40000);
  REQUIRE(found.formants.size() == 3);
  for (int i = 0; i < 3; ++i) CHECK(found.formants[i].frequency == Approx(formants[i]).epsilon(0.005));
  CHECK(found.misfit < 0.01);
}

TEST_CASE("bursts that no source tells of leave the resonances where they are", "[serial]") {
  // A voice of 197 Hz whose folds meet twice a period from half of the record on: that sounds through the same tract
  // and is in no flow. 12 times in 600 samples at the rate of the models.
  std::vector<double> source, bursts;
  unsigned noise = 1;
  for (int n = 0; n < 2400; ++n) {
    double value = 0;
    for (int k = 1; k < 12; ++k) value += std::sin(2 * std::numbers::pi * 197 * k * n / 40000.0) / (k * k);
    noise = noise * 1664525u + 1013904223u;
    source.push_back(value + 1e-4 * (noise / 4294967296.0 - 0.5));
    const bool meets = n > 1200 && (n % 203 == 0 || n % 203 == 20);
    bursts.push_back(source.back() + (meets ? 5 : 0));
  }
  // The models invent broad resonances for the bursts; what counts is that those of the tract are where they are.
  const auto found = driven_response(source, resonate(bursts, {370, 2530, 3700}, 15), 40000);
  for (const double frequency : {370.0, 2530.0, 3700.0}) {
    double nearest = 0;
    for (const auto& formant : found.formants) {
      if (std::abs(formant.frequency - frequency) < std::abs(nearest - frequency)) nearest = formant.frequency;
    }
    CHECK(nearest == Approx(frequency).epsilon(0.005));
  }
}

TEST_CASE("resonances without losses are found in voiced sound: poles on the unit circle", "[serial]") {
  // A duct, driven at its closed end and open at the other one, heard in its middle. With T = 2 L / c for the way there
  // and back, p(t) = q(t - T / 4) - q(t - 3 T / 4) - p(t - T).
  const double length = 0.17, speed = 350;
  const int steps = 44;  // of T
  const double rate = steps * speed / (2 * length);
  for (const double pitch : {110.0, 300.0}) {
    const std::vector<double> source =
        synthetic::samples(LiljencrantsFantFlux({.fundamental_frequency = pitch}), rate, 0.1);
    std::vector<double> response(source.size(), 0.0);
    const auto at = [](const std::vector<double>& series, std::size_t n, int delay) {
      return n < static_cast<std::size_t>(delay) ? 0 : series[n - delay];
    };
    for (std::size_t n = 0; n < source.size(); ++n) {
      response[n] = at(source, n, steps / 4) - at(source, n, 3 * steps / 4) - at(response, n, steps);
    }
    const auto found = driven_response(source, response, rate).formants;
    REQUIRE(found.size() == 4);  // below 4500 Hz
    for (int k = 0; k < 4; ++k) {
      CHECK(found[k].frequency == Approx((2 * k + 1) * speed / (4 * length)).epsilon(1e-3));
      CHECK(found[k].bandwidth >= 0);
      CHECK(found[k].bandwidth < 1);
    }
  }
}

TEST_CASE("silence and short series have no driven response", "[serial]") {
  CHECK(driven_response(std::vector<double>(4000, 0.0), std::vector<double>(4000, 0.0), 40000).formants.empty());
  CHECK(driven_response(std::vector<double>(20, 1.0), std::vector<double>(20, 1.0), 40000).formants.empty());
}
