#include "acoustic_solver/signals/ring_down.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "acoustic_solver/signals/dense.hpp"

namespace vocalis::acoustic {

namespace {

using Complex = std::complex<double>;
constexpr double pi = std::numbers::pi;

/// A low-passed series with every `factor`-th sample kept. Only samples whose whole filter lies inside the series are
/// made: then each damped exponential stays one, multiplied by `gain(z)`.
struct Thinned {
  std::vector<double> values;
  std::vector<double> filter;  ///< odd length, even symmetry
  int factor = 1;
  std::size_t first = 0;  ///< index in the series that values[0] belongs to

  Complex gain(Complex exponent_per_sample) const {
    const int half = static_cast<int>(filter.size() / 2);
    Complex sum = 0;
    for (int k = -half; k <= half; ++k) {
      sum += filter[static_cast<std::size_t>(k + half)] * std::exp(exponent_per_sample * static_cast<double>(k));
    }
    return sum;
  }
};

/// Pass band up to half of the new Nyquist frequency, stop band from one and a half of it, where aliases of the pass
/// band come from: a Blackman window of six new samples reaches about 74 dB there.
Thinned thin(std::span<const double> series, int factor, int maximum_samples) {
  Thinned result;
  result.factor = factor;
  const int half = factor == 1 ? 0 : 6 * factor;
  double sum = 0;
  for (int k = -half; k <= half; ++k) {
    const double x = static_cast<double>(k) / factor;
    const double sinc = k == 0 ? 1.0 : std::sin(pi * x) / (pi * x);
    const double phase = half == 0 ? 0.0 : pi * k / (half + 1);
    result.filter.push_back(sinc * (0.42 + 0.5 * std::cos(phase) + 0.08 * std::cos(2 * phase)));
    sum += result.filter.back();
  }
  for (double& tap : result.filter) tap /= sum;
  result.first = static_cast<std::size_t>(half);
  for (std::size_t n = result.first; n + result.first < series.size(); n += static_cast<std::size_t>(factor)) {
    if (result.values.size() == static_cast<std::size_t>(maximum_samples)) break;
    double value = 0;
    for (std::size_t k = 0; k < result.filter.size(); ++k) value += result.filter[k] * series[n - result.first + k];
    result.values.push_back(value);
  }
  return result;
}

/// Poles z of y_n = sum_m b_m z_m^n by the matrix pencil. The signal space is spanned by the singular vectors whose
/// values stand out of the floor, for which the median is taken: fewer than half of the vectors carry signal.
std::vector<Complex> poles(std::span<const double> y) {
  const int columns = static_cast<int>(y.size()) / 3;
  const int rows = static_cast<int>(y.size()) - columns;
  DenseMatrix hankel(rows, columns + 1);
  for (int j = 0; j <= columns; ++j) {
    for (int i = 0; i < rows; ++i) hankel(i, j) = y[static_cast<std::size_t>(i + j)];
  }
  const SingularValues space = singular_values(std::move(hankel));
  if (space.values.empty() || !(space.values[0] > 0)) return {};
  const double floor = std::max(1e-11 * space.values[0], 3 * space.values[space.values.size() / 2]);
  int order = 0;
  while (order < columns && space.values[static_cast<std::size_t>(order)] > floor) ++order;
  // V1, V2: the right singular vectors without their last and without their first entry. V2 = V1 A in the least
  // squares sense; the columns of V are orthonormal, so (V1^T V1)^-1 = I + w w^T / (1 - w.w), w the last entries.
  std::vector<double> w(static_cast<std::size_t>(order));
  double w_squared = 0;
  for (int i = 0; i < order; ++i) {
    w[static_cast<std::size_t>(i)] = space.right_transposed(i, columns);
    w_squared += w[static_cast<std::size_t>(i)] * w[static_cast<std::size_t>(i)];
  }
  if (w_squared > 1 - 1e-12) return {};
  DenseMatrix shift(order, order);
  for (int j = 0; j < order; ++j) {
    double along_w = 0;
    for (int i = 0; i < order; ++i) {
      double sum = 0;
      for (int n = 0; n < columns; ++n) sum += space.right_transposed(i, n) * space.right_transposed(j, n + 1);
      shift(i, j) = sum;
      along_w += w[static_cast<std::size_t>(i)] * sum;
    }
    for (int i = 0; i < order; ++i) shift(i, j) += w[static_cast<std::size_t>(i)] * along_w / (1 - w_squared);
  }
  return eigenvalues(std::move(shift));
}

/// Least squares fit of a pole's two real columns Re(z^n), -Im(z^n) (one for a real pole), with standard errors.
struct FittedPole {
  Complex pole;
  Complex amplitude;
  double doubt = 0;
};

std::vector<FittedPole> fit_amplitudes(std::span<const double> y, const std::vector<Complex>& all_poles) {
  std::vector<Complex> kept;
  int columns = 0;
  for (const Complex& pole : all_poles) {
    // One of each conjugate pair; a pole that grows a thousandfold over the record would ruin the fit.
    if (pole.imag() < 0 || std::abs(pole) == 0) continue;
    if (std::log(std::abs(pole)) * static_cast<double>(y.size()) > std::log(1e3)) continue;
    kept.push_back(pole);
    columns += pole.imag() > 0 ? 2 : 1;
  }
  const int rows = static_cast<int>(y.size());
  if (columns == 0 || columns >= rows) return {};
  DenseMatrix matrix(rows, columns);
  int column = 0;
  for (const Complex& pole : kept) {
    Complex power = 1;
    for (int n = 0; n < rows; ++n, power *= pole) {
      matrix(n, column) = power.real();
      if (pole.imag() > 0) matrix(n, column + 1) = -power.imag();
    }
    column += pole.imag() > 0 ? 2 : 1;
  }
  const SingularValues parts = singular_values(matrix);
  if (parts.values.empty()) return {};
  std::vector<double> solution(static_cast<std::size_t>(columns), 0.0);
  std::vector<double> variance(static_cast<std::size_t>(columns), 0.0);
  std::vector<double> residual(y.begin(), y.end());
  for (int k = 0; k < columns; ++k) {
    const double value = parts.values[static_cast<std::size_t>(k)];
    if (value < 1e-12 * parts.values[0]) continue;
    double part = 0;
    for (int n = 0; n < rows; ++n) part += parts.left(n, k) * y[static_cast<std::size_t>(n)];
    for (int n = 0; n < rows; ++n) residual[static_cast<std::size_t>(n)] -= parts.left(n, k) * part;
    for (int j = 0; j < columns; ++j) {
      const double weight = parts.right_transposed(k, j) / value;
      solution[static_cast<std::size_t>(j)] += weight * part;
      variance[static_cast<std::size_t>(j)] += weight * weight;
    }
  }
  double noise = 0;
  for (double value : residual) noise += value * value / (rows - columns);
  std::vector<FittedPole> result;
  std::size_t j = 0;
  for (const Complex& pole : kept) {
    const bool pair = pole.imag() > 0;
    const Complex amplitude(solution[j], pair ? solution[j + 1] : 0.0);
    const double error = std::sqrt(noise * (variance[j] + (pair ? variance[j + 1] : 0.0)));
    if (std::abs(amplitude) > 0) result.push_back({pole, amplitude, error / std::abs(amplitude)});
    j += pair ? 2 : 1;
  }
  return result;
}

// A formant's own level at its frequency, relative to the whole transfer function there; a weaker mode is only a small
// correction on the skirts of its neighbours, as a short record or a scattering mesh gives them [dB].
constexpr double least_own_level = -12;

std::size_t peak_of_pulse(std::span<const double> flux) {
  const auto smaller = [](double a, double b) { return std::abs(a) < std::abs(b); };
  return static_cast<std::size_t>(std::max_element(flux.begin(), flux.end(), smaller) - flux.begin());
}

}  // namespace

std::size_t end_of_pulse(std::span<const double> flux) {
  double largest = 0;
  for (double value : flux) largest = std::max(largest, std::abs(value));
  std::size_t end = flux.size();
  while (end > 0 && std::abs(flux[end - 1]) <= 1e-5 * largest) --end;
  return end;
}

double DampedMode::frequency() const { return exponent.imag() / (2 * pi); }
double DampedMode::bandwidth() const { return -exponent.real() / pi; }

std::vector<DampedMode> damped_modes(std::span<const double> series, double sampling_rate, const RingDown& settings) {
  assert(sampling_rate > 0 && settings.maximum_frequency > settings.minimum_frequency);
  if (!std::all_of(series.begin(), series.end(), [](double value) { return std::isfinite(value); })) return {};
  const int factor = std::max(1, static_cast<int>(sampling_rate / (4 * settings.maximum_frequency)));
  const Thinned thinned = thin(series, factor, settings.maximum_samples);
  if (thinned.values.size() < 12) return {};
  std::vector<DampedMode> modes;
  for (const FittedPole& fitted : fit_amplitudes(thinned.values, poles(thinned.values))) {
    DampedMode mode;
    const Complex per_sample = std::log(fitted.pole) / static_cast<double>(factor);
    mode.exponent = per_sample * sampling_rate;
    mode.doubt = fitted.doubt;
    mode.amplitude =
        fitted.amplitude / thinned.gain(per_sample) * std::exp(-per_sample * static_cast<double>(thinned.first));
    const bool resonance = mode.frequency() >= settings.minimum_frequency &&
                           mode.frequency() <= settings.maximum_frequency &&
                           mode.bandwidth() <= settings.maximum_bandwidth && mode.doubt <= settings.maximum_doubt;
    if (resonance) modes.push_back(mode);
  }
  std::sort(modes.begin(), modes.end(),
            [](const DampedMode& a, const DampedMode& b) { return a.frequency() < b.frequency(); });
  return modes;
}

PulseResponse analyse_pulse_response(std::span<const double> flux, std::span<const double> pressure,
                                     double sampling_rate, const RingDown& settings, double settle, double bin_width) {
  assert(flux.size() == pressure.size());
  PulseResponse result;
  const std::size_t begin = end_of_pulse(flux) + static_cast<std::size_t>(std::ceil(settle * sampling_rate));
  std::vector<DampedMode> modes;
  if (begin < pressure.size()) modes = damped_modes(pressure.subspan(begin), sampling_rate, settings);
  // Without any loss a mode neither grows nor decays, up to rounding: it counts as one that decays very slowly.
  constexpr double undamped = 0.01;  // [Hz]
  for (DampedMode& mode : modes) {
    if (std::abs(mode.bandwidth()) < undamped) mode.exponent.real(-pi * undamped);
  }
  result.transfer = transient_transfer_function(flux, pressure, sampling_rate, bin_width);
  const ComplexSpectrum source = transient_spectrum(flux, sampling_rate, bin_width);
  const double remaining = static_cast<double>(pressure.size() - std::min(begin, pressure.size()));
  for (const DampedMode& mode : modes) {
    if (mode.bandwidth() <= 0) continue;
    // What the record lost: sum over n >= N of Re(a z^n) e^{-i w n dt} dt, a geometric series for a z^n and one for its
    // conjugate, N the length of the record.
    const Complex z = std::exp(mode.exponent / sampling_rate);
    const Complex at_end = mode.amplitude * std::exp(mode.exponent * (remaining / sampling_rate));
    for (std::size_t k = 0; k < result.transfer.value.size(); ++k) {
      const double phase = 2 * pi * source.frequency[k] / sampling_rate;
      const Complex turn = std::polar(1.0, -phase);
      const Complex shift = std::polar(1.0, -phase * static_cast<double>(pressure.size()));
      const Complex tail = 0.5 * (at_end / (1.0 - z * turn) + std::conj(at_end) / (1.0 - std::conj(z) * turn));
      result.transfer.value[k] += shift * tail / sampling_rate / source.value[k];
    }
  }
  const std::vector<double> level = magnitude_level(result.transfer);
  const double width = result.transfer.frequency.size() > 1 ? result.transfer.frequency[1] : 1.0;
  for (const DampedMode& mode : modes) {
    Formant formant{mode.frequency(), mode.bandwidth()};
    const auto bin = static_cast<std::size_t>(std::lround(formant.frequency / width));
    if (bin >= level.size() || formant.bandwidth <= 0 || std::isnan(level[bin])) continue;
    // At its frequency a mode that begins with the pulse, as a exp(s t), contributes |a| / (2 pi bandwidth) / |S|.
    const double since_pulse = (static_cast<double>(begin) - static_cast<double>(peak_of_pulse(flux))) / sampling_rate;
    const double amplitude = std::abs(mode.amplitude * std::exp(-mode.exponent * since_pulse));
    const double own = amplitude / (2 * pi * formant.bandwidth) / std::abs(source.value[bin]);
    if (20 * std::log10(own) < level[bin] + least_own_level) continue;
    formant.level = level[bin];
    result.formants.push_back(formant);
  }
  return result;
}

}  // namespace vocalis::acoustic
