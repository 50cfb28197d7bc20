#include "acoustic_solver/signals/voice.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace vocalis::acoustic;

namespace {

constexpr double pi = std::numbers::pi;

/// A periodic sound with a weak fundamental: harmonics 1..8 with these amplitudes.
const std::vector<double> line_amplitudes{0.2, 1.0, 0.5, 0.3, 0.02, 0.1, 0.01, 0.05};

std::vector<double> voiced(double f0, double rate, double duration, double growth_rate = 0) {
  std::vector<double> series;
  for (int n = 0; n < static_cast<int>(duration * rate); ++n) {
    const double time = n / rate;
    double value = 0;
    for (std::size_t h = 0; h < line_amplitudes.size(); ++h) {
      const double number = static_cast<double>(h + 1);
      value += line_amplitudes[h] * std::cos(2 * pi * number * f0 * time + 0.7 * number * number);
    }
    series.push_back(0.4 + value * std::exp(growth_rate * time));
  }
  return series;
}

}  // namespace

TEST_CASE("five periods are enough for the pitch", "[serial]") {
  for (double f0 : {83.3, 100.0, 127.7, 220.0, 311.0}) {
    const Pitch pitch = fundamental_frequency(voiced(f0, 44100, 5.0 / f0), 44100);
    REQUIRE(pitch.frequency);
    CHECK(*pitch.frequency == Approx(f0).epsilon(2e-3));
    CHECK(pitch.confidence > 0.98);
    CHECK(pitch.periods == Approx(5).epsilon(0.01));
  }
  const Pitch longer = fundamental_frequency(voiced(127.7, 44100, 0.5), 44100);
  REQUIRE(longer.frequency);
  CHECK(*longer.frequency == Approx(127.7).epsilon(2e-4));
}

TEST_CASE("noise, silence and too short a record are unvoiced", "[serial]") {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::vector<double> noise(8820);
  for (double& value : noise) value = normal(generator);
  const Pitch pitch = fundamental_frequency(noise, 44100);
  CHECK(!pitch.frequency);
  CHECK(pitch.confidence < 0.3);
  CHECK(!fundamental_frequency(std::vector<double>(5000, 1.0), 44100).frequency);
  std::vector<double> two_periods;
  for (int n = 0; n < 882; ++n) two_periods.push_back(std::sin(2 * pi * n / 441.0));
  CHECK(!fundamental_frequency(two_periods, 44100).frequency);
  CHECK(!fundamental_frequency({}, 44100).frequency);
}

TEST_CASE("noise of a tenth of the voice's power leaves the pitch", "[serial]") {
  std::mt19937 generator(3);
  std::normal_distribution<double> normal(0.0, 0.26);  // the lines have a power of 0.70
  std::vector<double> series = voiced(110, 44100, 0.2);
  for (double& value : series) value += normal(generator);
  const Pitch pitch = fundamental_frequency(series, 44100);
  REQUIRE(pitch.frequency);
  CHECK(*pitch.frequency == Approx(110).epsilon(0.01));
  CHECK(pitch.confidence > 0.8);
  CHECK(pitch.confidence < 0.97);
}

TEST_CASE("harmonics have the amplitudes that were put in", "[serial]") {
  const auto lines = harmonics(voiced(123.4, 44100, 0.1), 44100, 123.4, 1000);
  REQUIRE(lines.size() == 8);
  for (std::size_t h = 0; h < lines.size(); ++h) {
    CHECK(lines[h].number == static_cast<int>(h) + 1);
    CHECK(lines[h].frequency == Approx(123.4 * static_cast<double>(h + 1)));
    CHECK(lines[h].amplitude == Approx(line_amplitudes[h]).epsilon(5e-3).margin(1e-4));
  }
  CHECK(lines[1].level == Approx(20 * std::log10(1 / std::sqrt(2.0) / 20e-6)).margin(0.05));
  CHECK(harmonics(voiced(100, 44100, 0.025), 44100, 100, 1000).empty());
}

TEST_CASE("growth per period is that of the exponential", "[serial]") {
  for (double factor : {0.5, 0.8, 0.97, 1.03, 1.2, 1.6}) {
    const double f0 = 118;
    const Growth found = growth(voiced(f0, 20000, 8.2 / f0, std::log(factor) * f0), 20000);
    CHECK(found.trend == (factor > 1 ? Trend::grows : Trend::decays));
    CHECK(found.factor == Approx(factor).epsilon(0.01));
    CHECK(found.scatter < 0.02);
    CHECK(found.frequency == Approx(f0).epsilon(0.01));
    CHECK(found.amplitudes.size() == 8);
  }
}

TEST_CASE("a steady oscillation on a drifting mean holds", "[serial]") {
  std::vector<double> gap = voiced(100, 20000, 0.1);
  for (std::size_t n = 0; n < gap.size(); ++n) gap[n] += 1e-4 * static_cast<double>(n);
  const Growth found = growth(gap, 20000);
  CHECK(found.trend == Trend::holds);
  CHECK(found.factor == Approx(1).epsilon(0.002));
  CHECK(std::string(name(found.trend)) == "holds");
  CHECK(growth(std::vector<double>(2000, 1.0), 20000).trend == Trend::none);
}
