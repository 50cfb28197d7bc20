#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <functional>

#include "acoustic_solver/signals/driven_response.hpp"
#include "acoustic_solver/signals/formants.hpp"
#include "acoustic_solver/signals/ring_down.hpp"
#include "acoustic_solver/sources/gaussian_pulse.hpp"
#include "acoustic_solver/sources/liljencrants_fant.hpp"
#include "acoustic_solver/sources/rosenberg.hpp"
#include "tests/acoustic_solver/signals/synthetic_vowel.hpp"

using namespace vocalis::acoustic;

namespace {

constexpr double rate = 44100;

using Finder = std::function<std::vector<Formant>(const std::vector<double>& source, const std::vector<double>& sound)>;

std::vector<std::vector<double>> voiced_sources(double pitch) {
  return {synthetic::samples(LiljencrantsFantFlux({.fundamental_frequency = pitch}), rate, 0.2),
          synthetic::samples(RosenbergFlux({.fundamental_frequency = pitch}), rate, 0.2)};
}

/// Largest relative distance of F1 to F`count` from the poles, over all vowels; formants are paired by their number.
double largest_error(const std::vector<double>& source, std::size_t count, double noise, const Finder& find) {
  double error = 0;
  for (const synthetic::Vowel& vowel : synthetic::vowels) {
    const std::vector<synthetic::Resonance> tract = synthetic::tract(vowel);
    std::vector<double> sound = synthetic::sound(source, tract, rate);
    synthetic::add_noise(sound, noise);
    const std::vector<Formant> found = find(source, sound);
    for (std::size_t k = 0; k < count; ++k) {
      const double here = found.size() > k ? std::abs(found[k].frequency / tract[k].frequency - 1) : 1;
      error = std::max(error, here);
    }
  }
  return error;
}

/// Vertices of the parabolas through the peaks of |H| in decibels, from 100 Hz on.
std::vector<Formant> peaks_of(const ComplexSpectrum& transfer) {
  const std::vector<double> level = magnitude_level(transfer);
  std::vector<Formant> peaks;
  for (std::size_t k = 1; k + 1 < level.size(); ++k) {
    if (transfer.frequency[k] < 100 || !(level[k] > level[k - 1] && level[k] >= level[k + 1])) continue;
    const double shift = 0.5 * (level[k - 1] - level[k + 1]) / (level[k - 1] - 2 * level[k] + level[k + 1]);
    peaks.push_back({.frequency = (static_cast<double>(k) + shift) * transfer.frequency[1]});
  }
  return peaks;
}

std::vector<Formant> by_source(const std::vector<double>& source, const std::vector<double>& sound) {
  return driven_response(source, sound, rate).formants;
}

std::vector<Formant> by_sound_alone(const std::vector<double>&, const std::vector<double>& sound) {
  return formants_by_prediction(sound, rate, {});
}

}  // namespace

TEST_CASE("the ring after a pulse gives the poles of ten vowels", "[serial]") {
  const std::vector<double> pulse = synthetic::samples(GaussianFlux({1, 8000}), rate, 0.05);
  const auto ring = [](const std::vector<double>& source, const std::vector<double>& sound) {
    return analyse_pulse_response(source, sound, rate, {.maximum_bandwidth = 600}).formants;
  };
  CHECK(largest_error(pulse, 4, 0, ring) < 1e-4);
  CHECK(largest_error(pulse, 3, 1e-3, ring) < 0.01);
  // Peaks of |H| lie beside the poles where the skirts of other resonances are steep, yet within 1 %.
  const auto peaks = [](const std::vector<double>& source, const std::vector<double>& sound) {
    const auto response = analyse_pulse_response(source, sound, rate, {.maximum_bandwidth = 600});
    return peaks_of(response.transfer);
  };
  CHECK(largest_error(pulse, 4, 0, peaks) < 0.01);
}

TEST_CASE("voiced sound and its source give the poles of ten vowels, however high the pitch", "[serial]") {
  for (const double pitch : {100.0, 150.0, 220.0, 300.0}) {
    for (const std::vector<double>& source : voiced_sources(pitch)) {
      CAPTURE(pitch);
      CHECK(largest_error(source, 4, 0, by_source) < 1e-3);
      CHECK(largest_error(source, 2, 1e-3, by_source) < 0.01);
    }
  }
}

TEST_CASE("linear prediction of the sound alone takes a harmonic for F1 where the pitch is high", "[serial]") {
  // 300 Hz: F1 of /i/ lies at 270 Hz, and no harmonic does.
  const std::vector<double> source = voiced_sources(300).back();
  const std::vector<synthetic::Resonance> tract = synthetic::tract(synthetic::vowels.front());
  const std::vector<double> sound = synthetic::sound(source, tract, rate);
  const double alone = by_sound_alone(source, sound).front().frequency;
  CHECK(std::abs(alone / tract[0].frequency - 1) > 0.1);
  CHECK(by_source(source, sound).front().frequency == Approx(tract[0].frequency).epsilon(1e-3));
}

TEST_CASE("the table of ten vowels", "[.ten_vowels]") {
  std::puts("largest error of F1, F2, F3, F4 [%]; source known, by noise over sound; then the sound alone");
  for (const double pitch : {100.0, 150.0, 220.0, 300.0}) {
    for (const std::vector<double>& source : voiced_sources(pitch)) {
      std::printf("%3g Hz ", pitch);
      for (const double noise : {0.0, 1e-3, 1e-2}) {
        std::printf(" | %g:", noise);
        for (std::size_t k = 1; k <= 4; ++k) std::printf(" %.3g", 100 * largest_error(source, k, noise, by_source));
      }
      std::printf(" | alone:");
      for (std::size_t k = 1; k <= 3; ++k) std::printf(" %.3g", 100 * largest_error(source, k, 0, by_sound_alone));
      std::puts("");
    }
  }
}
