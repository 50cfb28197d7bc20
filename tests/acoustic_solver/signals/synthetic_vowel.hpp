#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

/// Vowels whose resonances are known, for tests of how formants are found.
namespace synthetic {

struct Resonance {
  double frequency;
  double bandwidth;
};

/// Klatt's digital resonator: y_n = A x_n + B y_{n-1} + C y_{n-2}, unit gain at 0 Hz. Source: Klatt 1980, J. Acoust.
/// Soc. Am. 67, 971, eq. 2.
inline void resonate(std::vector<double>& sound, const Resonance& resonance, double rate) {
  constexpr double pi = std::numbers::pi;
  const double c = -std::exp(-2 * pi * resonance.bandwidth / rate);
  const double b = 2 * std::exp(-pi * resonance.bandwidth / rate) * std::cos(2 * pi * resonance.frequency / rate);
  double before = 0, before_that = 0;
  for (double& value : sound) {
    value = (1 - b - c) * value + b * before + c * before_that;
    before_that = before;
    before = value;
  }
}

struct Vowel {
  std::string name;
  std::array<double, 3> formants;  // [Hz]
};

/// Mean formants of men. Source: Peterson & Barney 1952, J. Acoust. Soc. Am. 24, 175, table II.
inline const std::vector<Vowel> vowels = {{"i", {270, 2290, 3010}},  {"I", {390, 1990, 2550}}, {"E", {530, 1840, 2480}},
                                          {"ae", {660, 1720, 2410}}, {"A", {730, 1090, 2440}}, {"O", {570, 840, 2410}},
                                          {"U", {440, 1020, 2240}},  {"u", {300, 870, 2240}},  {"V", {640, 1190, 2390}},
                                          {"er", {490, 1350, 1690}}};

/// The tract of a vowel: three formants of its own, and two that all share.
inline std::vector<Resonance> tract(const Vowel& vowel) {
  return {{vowel.formants[0], 60}, {vowel.formants[1], 80}, {vowel.formants[2], 120}, {3500, 175}, {4500, 250}};
}

/// Sound of a source whose samples are the flux through the glottis: its derivative (radiation) through the tract.
inline std::vector<double> sound(std::span<const double> flux, const std::vector<Resonance>& tract, double rate) {
  std::vector<double> result;
  for (std::size_t n = 0; n < flux.size(); ++n) result.push_back((flux[n] - (n > 0 ? flux[n - 1] : 0)) * rate);
  for (const Resonance& resonance : tract) resonate(result, resonance, rate);
  return result;
}

/// Adds even noise whose rms is `part` of the series' own, the same one every time.
inline void add_noise(std::vector<double>& series, double part) {
  double squares = 0;
  for (const double value : series) squares += value * value;
  const double rms = std::sqrt(squares / static_cast<double>(series.size()));
  unsigned state = 1;
  for (double& value : series) {
    state = state * 1664525U + 1013904223U;
    value += part * rms * std::sqrt(12.0) * (state / 4294967296.0 - 0.5);
  }
}

/// Samples of a prescribed flux.
template <class Flux>
std::vector<double> samples(const Flux& flux, double rate, double duration) {
  std::vector<double> result;
  for (int n = 0; n < static_cast<int>(duration * rate); ++n) result.push_back(flux.value(n / rate));
  return result;
}

}  // namespace synthetic
