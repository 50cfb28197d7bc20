#include "acoustic_solver/signals/formants.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "acoustic_solver/signals/spectrum.hpp"
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

TEST_CASE("a ring-down without window gives formants and bandwidths", "[serial]") {
  std::vector<double> sound(2000, 0.0);
  sound[10] = 1;
  const std::vector<Resonance> tract{{600, 60}, {1200, 80}, {2500, 120}, {3400, 150}};
  for (const Resonance& resonance : tract) resonate(sound, resonance, 10000);
  LinearPrediction settings;
  settings.formants = 4;
  settings.pre_emphasis = 1e5;  // none
  settings.window = LinearPrediction::Window::none;
  const auto formants = formants_by_prediction(sound, 10000, settings);
  REQUIRE(formants.size() == 4);
  for (std::size_t k = 0; k < 4; ++k) {
    CAPTURE(k, formants[k].frequency, formants[k].bandwidth);
    CHECK(formants[k].frequency == Approx(tract[k].frequency).epsilon(0.01));
    CHECK(formants[k].bandwidth == Approx(tract[k].bandwidth).epsilon(0.5));
  }
}

TEST_CASE("too short a record has no formants", "[serial]") {
  CHECK(formants_by_prediction(std::vector<double>(20, 1.0), 44100, {}).empty());
  CHECK(formants_by_prediction({}, 44100, {}).empty());
}

TEST_CASE("peaks of a spectrum give frequency, level and bandwidth", "[serial]") {
  const std::vector<Resonance> tract{{500, 50}, {1500, 90}, {2700, 130}};
  const auto level_at = [&](double frequency) {
    const std::complex<double> s(0, 2 * pi * frequency);
    std::complex<double> h = 0;
    for (const Resonance& r : tract) {
      const std::complex<double> pole(-pi * r.bandwidth, 2 * pi * r.frequency);
      h += 1e3 / ((s - pole) * (s - std::conj(pole))) * std::abs(pole);
    }
    return 20 * std::log10(std::abs(h));
  };
  std::vector<double> level;
  for (int k = 0; k < 700; ++k) level.push_back(level_at(7.0 * k));
  const auto formants = formants_by_peaks(level, 7.0, {});
  REQUIRE(formants.size() == 3);
  for (std::size_t k = 0; k < 3; ++k) {
    double top = tract[k].frequency - 20;  // the peak lies beside the pole, on the skirts of the others
    for (double f = top; f < tract[k].frequency + 20; f += 0.05) top = level_at(f) > level_at(top) ? f : top;
    CHECK(formants[k].frequency == Approx(top).margin(0.3));  // a bin may be 3.5 Hz away
    CHECK(formants[k].level == Approx(level_at(top)).margin(0.02));
    CHECK(formants[k].bandwidth == Approx(tract[k].bandwidth).epsilon(0.03));
  }
}

TEST_CASE("ripples below the prominence and peaks outside the range do not count", "[serial]") {
  std::vector<double> level;
  for (int k = 0; k < 1000; ++k) level.push_back(-std::abs(k - 400.3) * 0.1 + 0.2 * std::sin(1.1 * k));
  CHECK(formants_by_peaks(level, 1.0, {100, 900, 1.0}).size() == 1);
  CHECK(formants_by_peaks(level, 1.0, {100, 900, 0.1}).size() > 5);
  CHECK(formants_by_peaks(level, 1.0, {500, 900, 1.0}).empty());
  level.assign(1000, -100.0);
  for (int k = 100; k < 900; k += 100) level[static_cast<std::size_t>(k)] = -0.1 * k;
  CHECK(formants_by_peaks(level, 1.0, {50, 950, 1.0, 35}).size() == 4);  // -10, -20, -30, -40 dB
}
