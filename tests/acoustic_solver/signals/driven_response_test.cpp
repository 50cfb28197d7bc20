#include "acoustic_solver/signals/driven_response.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using vocalis::acoustic::driven_response;

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

TEST_CASE("silence and short series have no driven response", "[serial]") {
  CHECK(driven_response(std::vector<double>(4000, 0.0), std::vector<double>(4000, 0.0), 40000).formants.empty());
  CHECK(driven_response(std::vector<double>(20, 1.0), std::vector<double>(20, 1.0), 40000).formants.empty());
}
