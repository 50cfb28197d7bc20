#include "acoustic_solver/signals/spectrum.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "acoustic_solver/signals/fourier.hpp"

namespace vocalis::acoustic {

namespace {

using Complex = std::complex<double>;

/// Periodic Hann window: the one whose shifted copies by half its length add up to one.
std::vector<double> hann_window(int length) {
  std::vector<double> window(static_cast<std::size_t>(length));
  for (int n = 0; n < length; ++n) {
    window[static_cast<std::size_t>(n)] = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * n / length);
  }
  return window;
}

std::vector<Complex> windowed_transform(std::span<const double> segment, std::span<const double> window) {
  const double mean = std::accumulate(segment.begin(), segment.end(), 0.0) / static_cast<double>(segment.size());
  std::vector<double> windowed(segment.size());
  for (std::size_t n = 0; n < segment.size(); ++n) windowed[n] = (segment[n] - mean) * window[n];
  return fourier_transform(windowed, static_cast<int>(windowed.size()));
}

std::vector<double> bins(std::size_t count, double width) {
  std::vector<double> frequency(count);
  for (std::size_t k = 0; k < count; ++k) frequency[k] = width * static_cast<double>(k);
  return frequency;
}

/// Where the segments of a series begin; half of each (rounded down) overlaps the next.
struct Segments {
  int length = 0;
  int step = 0;
  int count = 0;

  Segments(std::size_t samples, int wanted_length) {
    assert(wanted_length >= 2);
    length = std::min(wanted_length, static_cast<int>(samples));
    step = length - length / 2;
    count = length < 2 ? 0 : (static_cast<int>(samples) - length / 2) / step;
  }
  std::span<const double> of(std::span<const double> series, int segment) const {
    return series.subspan(static_cast<std::size_t>(segment * step), static_cast<std::size_t>(length));
  }
};

double level(double power, double reference) { return std::max(-300.0, 10 * std::log10(power / reference)); }

}  // namespace

PowerSpectrum welch(std::span<const double> series, double sampling_rate, int segment_length) {
  assert(sampling_rate > 0);
  const Segments segments(series.size(), segment_length);
  PowerSpectrum result;
  if (segments.count == 0) return result;
  const std::vector<double> window = hann_window(segments.length);
  const double sum = std::accumulate(window.begin(), window.end(), 0.0);
  const double sum_of_squares = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  result.segments = segments.count;
  result.bin_width = sampling_rate / segments.length;
  result.noise_bandwidth = sampling_rate * sum_of_squares / (sum * sum);
  result.density.assign(static_cast<std::size_t>(segments.length / 2 + 1), 0.0);
  result.frequency = bins(result.density.size(), result.bin_width);
  for (int segment = 0; segment < segments.count; ++segment) {
    const auto transform = windowed_transform(segments.of(series, segment), window);
    for (std::size_t k = 0; k < transform.size(); ++k) result.density[k] += std::norm(transform[k]);
  }
  const double scale = 1 / (sampling_rate * sum_of_squares * segments.count);
  for (std::size_t k = 0; k < result.density.size(); ++k) {
    // Each bin stands for its negative frequency too, but for 0 and half the sampling rate, which have none.
    const bool alone = k == 0 || (segments.length % 2 == 0 && k + 1 == result.density.size());
    result.density[k] *= alone ? scale : 2 * scale;
  }
  return result;
}

std::vector<double> density_level(const PowerSpectrum& spectrum) {
  std::vector<double> levels;
  levels.reserve(spectrum.density.size());
  for (double density : spectrum.density) levels.push_back(level(density, reference_pressure * reference_pressure));
  return levels;
}

double sound_pressure_level(std::span<const double> pressure) {
  if (pressure.empty()) return -300;
  const double count = static_cast<double>(pressure.size());
  const double mean = std::accumulate(pressure.begin(), pressure.end(), 0.0) / count;
  double sum = 0;
  for (double value : pressure) sum += (value - mean) * (value - mean);
  return level(sum / count, reference_pressure * reference_pressure);
}

ComplexSpectrum transient_spectrum(std::span<const double> series, double sampling_rate, double bin_width) {
  assert(sampling_rate > 0 && bin_width > 0);
  ComplexSpectrum result;
  if (series.empty()) return result;
  const int length = padded_length(std::max(static_cast<double>(series.size()), sampling_rate / bin_width));
  result.value = fourier_transform(series, length);
  for (Complex& value : result.value) value /= sampling_rate;
  result.frequency = bins(result.value.size(), sampling_rate / length);
  return result;
}

ComplexSpectrum transient_transfer_function(std::span<const double> source, std::span<const double> response,
                                            double sampling_rate, double bin_width, double source_floor) {
  assert(source.size() == response.size());
  const ComplexSpectrum from = transient_spectrum(source, sampling_rate, bin_width);
  ComplexSpectrum result = transient_spectrum(response, sampling_rate, bin_width);
  double largest = 0;
  for (const Complex& value : from.value) largest = std::max(largest, std::abs(value));
  for (std::size_t k = 0; k < result.value.size(); ++k) {
    const bool heard = largest > 0 && std::abs(from.value[k]) >= source_floor * largest;
    result.value[k] = heard ? result.value[k] / from.value[k] : Complex(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

std::vector<double> magnitude_level(const ComplexSpectrum& spectrum) {
  std::vector<double> levels;
  levels.reserve(spectrum.value.size());
  for (const Complex& value : spectrum.value) {
    levels.push_back(std::isnan(value.real()) ? value.real() : level(std::norm(value), 1));
  }
  return levels;
}

}  // namespace vocalis::acoustic
