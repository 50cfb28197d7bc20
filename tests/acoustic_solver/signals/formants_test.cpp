#include "acoustic_solver/signals/formants.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/sources/liljencrants_fant.hpp"
#include "tests/acoustic_solver/signals/synthetic_vowel.hpp"

using namespace vocalis::acoustic;
using synthetic::Resonance;
using synthetic::resonate;

namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> vowel(const std::vector<Resonance>& tract, double f0, double rate, double duration) {
  const LiljencrantsFantFlux glottis(LiljencrantsFantPulse{f0, 0.4, 0.6, 0.75, 0.01});
  std::vector<double> sound;
  for (int n = 0; n < static_cast<int>(duration * rate); ++n) sound.push_back(glottis.rate(n / rate));
  for (const Resonance& resonance : tract) resonate(sound, resonance, rate);
  return sound;
}

}  // namespace

TEST_CASE("Burg's recursion finds the coefficients of an autoregressive series", "[serial]") {
  // A pure oscillation x_n = 2 cos(w) x_{n-1} - x_{n-2}: the reflection of order two is 1 up to the ends of the series.
  std::vector<double> series;
  for (int n = 0; n < 4000; ++n) series.push_back(std::cos(0.5 * n + 0.2));
  const auto a = burg_coefficients(series, 2);
  CHECK(a[0] == Approx(2 * std::cos(0.5)).epsilon(1e-3));
  CHECK(a[1] == Approx(-1).epsilon(1e-3));
  const auto silence = burg_coefficients(std::vector<double>(50, 0.0), 4);
  CHECK(silence == std::vector<double>(4, 0.0));
}

TEST_CASE("formants of a synthetic vowel are found by linear prediction", "[serial]") {
  const std::vector<Resonance> tract{{600, 60}, {1200, 80}, {2500, 120}, {3400, 150}, {4400, 200}};
  const auto formants = formants_by_prediction(vowel(tract, 100, 44100, 0.4), 44100, {});
  REQUIRE(formants.size() >= 4);
  // Linear prediction follows the harmonics, here 100 Hz apart, and the tilt of the glottal pulse: some per cent.
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k, formants[k].frequency, formants[k].bandwidth);
    CHECK(formants[k].frequency == Approx(tract[k].frequency).epsilon(0.04));
    CHECK(formants[k].bandwidth < 3 * tract[k].bandwidth);
  }
}

TEST_CASE("too short a record has no formants", "[serial]") {
  CHECK(formants_by_prediction(std::vector<double>(20, 1.0), 44100, {}).empty());
  CHECK(formants_by_prediction({}, 44100, {}).empty());
}
