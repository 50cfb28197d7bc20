#include "acoustic_solver/signals/formants.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

#include "acoustic_solver/signals/dense.hpp"
#include "acoustic_solver/signals/resample.hpp"

namespace vocalis::acoustic {

namespace {

constexpr double safety_margin = 50;  // Praat drops formants this near to 0 and to the ceiling [Hz]

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// The formants of one frame: poles of the prediction filter, put inside the unit circle.
std::vector<Formant> formants_of_frame(std::span<const double> frame, double rate, const LinearPrediction& settings) {
  std::vector<double> coefficients = burg_coefficients(frame, 2 * settings.formants);
  for (double& coefficient : coefficients) coefficient = -coefficient;
  std::vector<Formant> formants;
  for (std::complex<double> root : polynomial_roots(coefficients)) {
    if (root.imag() <= 0) continue;
    if (std::abs(root) > 1) root = 1.0 / std::conj(root);
    const double frequency = std::arg(root) * rate / (2 * std::numbers::pi);
    if (frequency < safety_margin || frequency > 0.5 * rate - safety_margin) continue;
    Formant formant;
    formant.frequency = frequency;
    formant.bandwidth = -std::log(std::abs(root)) * rate / std::numbers::pi;
    if (formant.bandwidth <= settings.maximum_bandwidth) formants.push_back(formant);
  }
  std::sort(formants.begin(), formants.end(),
            [](const Formant& a, const Formant& b) { return a.frequency < b.frequency; });
  return formants;
}

/// Praat's Gaussian-like window, zero at its ends: (exp(-12 x^2) - exp(-12)) / (1 - exp(-12)), -1 < x < 1.
std::vector<double> gaussian_window(std::size_t length) {
  std::vector<double> window(length);
  const double edge = std::exp(-12.0);
  for (std::size_t n = 0; n < length; ++n) {
    const double x = (2 * static_cast<double>(n) - static_cast<double>(length - 1)) / static_cast<double>(length + 1);
    window[n] = (std::exp(-12 * x * x) - edge) / (1 - edge);
  }
  return window;
}

/// Where frames of a length begin that follow each other at `step` (perhaps not a whole number of samples), the first
/// as far from the beginning of the series as the last from its end.
std::vector<std::size_t> frame_begins(std::size_t series, std::size_t length, double step) {
  const double room = static_cast<double>(series - length);
  const double last = std::floor(room / step);
  std::vector<std::size_t> begins;
  for (double k = 0; k <= last; ++k) {
    begins.push_back(static_cast<std::size_t>(std::lround(0.5 * (room - last * step) + k * step)));
  }
  return begins;
}

}  // namespace

std::vector<double> burg_coefficients(std::span<const double> series, int order) {
  assert(series.size() > static_cast<std::size_t>(order));
  std::vector<double> forward(series.begin(), series.end());
  std::vector<double> backward = forward;
  std::vector<double> coefficients;
  for (std::size_t m = 1; m <= static_cast<std::size_t>(order); ++m) {
    double cross = 0;
    double power = 0;
    for (std::size_t n = m; n < series.size(); ++n) {
      cross += forward[n] * backward[n - 1];
      power += forward[n] * forward[n] + backward[n - 1] * backward[n - 1];
    }
    const double reflection = power > 0 ? 2 * cross / power : 0.0;
    std::vector<double> next = coefficients;
    for (std::size_t k = 0; k < coefficients.size(); ++k) next[k] -= reflection * coefficients[m - 2 - k];
    next.push_back(reflection);
    coefficients = next;
    for (std::size_t n = series.size(); n-- > m;) {
      const double ahead = forward[n];
      forward[n] -= reflection * backward[n - 1];
      backward[n] = backward[n - 1] - reflection * ahead;
    }
  }
  return coefficients;
}

std::vector<Formant> formants_by_prediction(std::span<const double> series, double sampling_rate,
                                            const LinearPrediction& settings) {
  assert(settings.formants > 0 && settings.ceiling > 2 * safety_margin && settings.window_length > 0);
  const double rate = 2 * settings.ceiling;
  const int order = 2 * settings.formants;
  std::vector<double> sound = resample_sharply(series, sampling_rate, rate);
  if (sound.size() < static_cast<std::size_t>(2 * order + 2)) return {};
  const double factor = std::exp(-2 * std::numbers::pi * settings.pre_emphasis / rate);
  for (std::size_t n = sound.size(); n-- > 1;) sound[n] -= factor * sound[n - 1];
  const auto length = std::min(sound.size(), static_cast<std::size_t>(std::lround(2 * settings.window_length * rate)));
  if (length < static_cast<std::size_t>(2 * order + 2)) return {};
  const std::vector<double> window = gaussian_window(length);
  std::vector<std::vector<Formant>> frames;
  std::vector<double> frame(length);
  for (const std::size_t begin : frame_begins(sound.size(), length, 0.25 * settings.window_length * rate)) {
    for (std::size_t n = 0; n < length; ++n) frame[n] = window[n] * sound[begin + n];
    frames.push_back(formants_of_frame(frame, rate, settings));
  }
  std::vector<Formant> result;
  for (std::size_t k = 0;; ++k) {
    std::vector<double> frequencies;
    std::vector<double> bandwidths;
    for (const auto& formants : frames) {
      if (formants.size() <= k) continue;
      frequencies.push_back(formants[k].frequency);
      bandwidths.push_back(formants[k].bandwidth);
    }
    if (frequencies.empty() || 2 * frequencies.size() < frames.size()) return result;
    Formant formant;
    formant.frequency = median(frequencies);
    formant.bandwidth = median(bandwidths);
    result.push_back(formant);
  }
}

}  // namespace vocalis::acoustic
