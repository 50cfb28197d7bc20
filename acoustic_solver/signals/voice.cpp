#include "acoustic_solver/signals/voice.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include "acoustic_solver/signals/fourier.hpp"
#include "acoustic_solver/signals/spectrum.hpp"

namespace vocalis::acoustic {

namespace {

std::vector<double> without_mean(std::span<const double> series) {
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / static_cast<double>(series.size());
  std::vector<double> result(series.begin(), series.end());
  for (double& value : result) value -= mean;
  return result;
}

/// r(0) .. r(longest) as defined in the header.
std::vector<double> normalised_correlation(std::span<const double> x, std::size_t longest) {
  const int length = padded_length(static_cast<double>(x.size() + longest + 1));
  std::vector<std::complex<double>> power = fourier_transform(x, length);
  for (auto& value : power) value = std::norm(value);
  std::vector<double> correlation = inverse_fourier_transform(power, length);
  std::vector<double> energy(x.size() + 1, 0.0);
  for (std::size_t n = 0; n < x.size(); ++n) energy[n + 1] = energy[n] + x[n] * x[n];
  correlation.resize(longest + 1);
  for (std::size_t lag = 0; lag <= longest; ++lag) {
    const double product = energy[x.size() - lag] * (energy[x.size()] - energy[lag]);
    correlation[lag] = product > 0 ? correlation[lag] / std::sqrt(product) : 0.0;
  }
  return correlation;
}

/// Vertex of the parabola through a highest value and its neighbours: place (relative to the middle) and height.
struct Vertex {
  double shift = 0;
  double height = 0;
};

Vertex vertex(double left, double middle, double right) {
  const double curvature = left - 2 * middle + right;
  if (!(curvature < 0)) return {0, middle};
  const double shift = 0.5 * (left - right) / curvature;
  return {shift, middle - 0.25 * (left - right) * shift};
}

/// Greatest of sign * x in [begin, end), by a parabola where it is not at an end.
double extremum(std::span<const double> x, std::size_t begin, std::size_t end, double sign) {
  std::size_t best = begin;
  for (std::size_t n = begin; n < end; ++n) {
    if (sign * x[n] > sign * x[best]) best = n;
  }
  if (best == begin || best + 1 >= end) return x[best];
  return sign * vertex(sign * x[best - 1], sign * x[best], sign * x[best + 1]).height;
}

}  // namespace

Pitch fundamental_frequency(std::span<const double> series, double sampling_rate, const PitchSettings& settings) {
  assert(sampling_rate > 0 && settings.minimum_frequency < settings.maximum_frequency);
  Pitch pitch;
  if (series.size() < 8) return pitch;
  const std::vector<double> x = without_mean(series);
  const auto shortest =
      std::max<std::size_t>(1, static_cast<std::size_t>(std::floor(sampling_rate / settings.maximum_frequency)));
  const auto longest =
      std::min(static_cast<std::size_t>(std::ceil(sampling_rate / settings.minimum_frequency)), series.size() / 4);
  if (longest <= shortest) return pitch;
  const std::vector<double> correlation = normalised_correlation(x, longest + 1);
  double best_score = 0;
  double best_lag = 0;
  for (std::size_t lag = shortest; lag <= longest; ++lag) {
    if (!(correlation[lag] > correlation[lag - 1] && correlation[lag] >= correlation[lag + 1])) continue;
    const Vertex top = vertex(correlation[lag - 1], correlation[lag], correlation[lag + 1]);
    const double exact_lag = static_cast<double>(lag) + top.shift;
    const double score = top.height - settings.octave_cost * std::log2(exact_lag / static_cast<double>(shortest));
    if (best_lag > 0 && score <= best_score) continue;
    best_score = score;
    best_lag = exact_lag;
    pitch.confidence = std::clamp(top.height, 0.0, 1.0);
  }
  if (best_lag > 0 && pitch.confidence >= settings.minimum_confidence) {
    pitch.frequency = sampling_rate / best_lag;
    pitch.periods = static_cast<double>(series.size()) / best_lag;
  }
  return pitch;
}

std::vector<Harmonic> harmonics(std::span<const double> series, double sampling_rate, double fundamental_frequency,
                                double maximum_frequency) {
  assert(sampling_rate > 0 && fundamental_frequency > 0);
  const double period = sampling_rate / fundamental_frequency;
  const double periods = std::floor(static_cast<double>(series.size()) / period);
  std::vector<Harmonic> result;
  if (periods < 3) return result;
  const auto length = std::min(series.size(), static_cast<std::size_t>(std::lround(periods * period)));
  const std::vector<double> x = without_mean(series.last(length));
  const double highest = std::min(maximum_frequency, 0.5 * sampling_rate);
  for (int number = 1; number * fundamental_frequency <= highest; ++number) {
    std::complex<double> sum = 0;
    double weights = 0;
    for (std::size_t n = 0; n < length; ++n) {
      const double weight = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(n) / (periods * period));
      weights += weight;
      const double phase = 2 * std::numbers::pi * number * static_cast<double>(n) / period;
      sum += weight * x[n] * std::polar(1.0, -phase);
    }
    Harmonic harmonic{number, number * fundamental_frequency, 2 * std::abs(sum) / weights, 0};
    const double rms = harmonic.amplitude / std::numbers::sqrt2;
    harmonic.level = std::max(-300.0, 20 * std::log10(rms / reference_pressure));
    result.push_back(harmonic);
  }
  return result;
}

Growth growth(std::span<const double> series, double sampling_rate, double tolerance, const PitchSettings& settings) {
  Growth result;
  const Pitch pitch = fundamental_frequency(series, sampling_rate, settings);
  if (!pitch.frequency) return result;
  result.frequency = *pitch.frequency;
  const double period = sampling_rate / result.frequency;
  const auto count = static_cast<int>(static_cast<double>(series.size()) / period);
  for (int k = 0; k < count; ++k) {
    const auto begin = static_cast<std::size_t>(std::lround(k * period));
    const auto end = std::min(series.size(), static_cast<std::size_t>(std::lround((k + 1) * period)));
    result.amplitudes.push_back(0.5 * (extremum(series, begin, end, 1) - extremum(series, begin, end, -1)));
  }
  // Least squares line through (k, log amplitude).
  const double middle = 0.5 * (count - 1);
  double mean = 0;
  for (double amplitude : result.amplitudes) {
    if (!(amplitude > 0)) return result;
    mean += std::log(amplitude) / count;
  }
  double slope = 0;
  for (int k = 0; k < count; ++k) {
    slope += (k - middle) * std::log(result.amplitudes[static_cast<std::size_t>(k)]);
  }
  slope *= 12 / (static_cast<double>(count) * (static_cast<double>(count) * count - 1));
  double squares = 0;
  for (int k = 0; k < count; ++k) {
    const double deviation = std::log(result.amplitudes[static_cast<std::size_t>(k)]) - mean - slope * (k - middle);
    squares += deviation * deviation / count;
  }
  result.factor = std::exp(slope);
  result.scatter = std::sqrt(squares);
  result.trend = std::abs(result.factor - 1) <= tolerance ? Trend::holds
                 : result.factor > 1                      ? Trend::grows
                                                          : Trend::decays;
  return result;
}

const char* name(Trend trend) {
  switch (trend) {
    case Trend::decays:
      return "decays";
    case Trend::holds:
      return "holds";
    case Trend::grows:
      return "grows";
    case Trend::none:
      break;
  }
  return "none";
}

}  // namespace vocalis::acoustic
