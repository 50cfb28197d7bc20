#include "acoustic_solver/signals/driven_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "acoustic_solver/signals/dense.hpp"
#include "acoustic_solver/signals/recurring_formants.hpp"
#include "acoustic_solver/signals/resample.hpp"

namespace vocalis::acoustic {

namespace {

// Huber's weights: 95 % efficient where errors are normal; the median of |error| is so much of a standard deviation;
// passes that change formants by far less than what orders differ by.
constexpr double kHuberLimit = 1.345, kDeviationOfMedian = 1.4826;
constexpr int kHuberPasses = 10;

double root_mean_square(std::span<const double> values) {
  double squares = 0;
  for (const double value : values) squares += value * value;
  return values.empty() ? 0 : std::sqrt(squares / static_cast<double>(values.size()));
}

std::vector<double> without_mean(std::vector<double> values) {
  double mean = 0;
  for (const double value : values) mean += value / static_cast<double>(values.size());
  for (double& value : values) value -= mean;
  return values;
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Equations whose last column is what the others, each times its coefficient, shall add up to. Both series over their
/// scales.
DenseMatrix regression(std::span<const double> source, double source_scale, std::span<const double> response,
                       double response_scale, int order) {
  DenseMatrix result(static_cast<int>(response.size()) - order, 2 * order + 1);
  for (int row = 0; row < result.rows; ++row) {
    const int n = row + order;
    for (int k = 0; k < order; ++k) {
      result(row, k) = response[n - 1 - k] / response_scale;
      result(row, order + k) = source[n - k] / source_scale;
    }
    result(row, 2 * order) = response[n] / response_scale;
  }
  return result;
}

/// Weighted least squares; empty if the equations have no solution.
std::vector<double> solve(DenseMatrix equations, const std::vector<double>& weights) {
  for (int j = 0; j < equations.columns; ++j) {
    for (int row = 0; row < equations.rows; ++row) equations(row, j) *= weights[row];
  }
  const DenseMatrix triangle = upper_triangle(std::move(equations));
  const int unknowns = triangle.columns - 1;
  DenseMatrix left_side(triangle.rows, unknowns);
  std::copy_n(triangle.values.begin(), left_side.values.size(), left_side.values.begin());
  const SingularValues factors = singular_values(std::move(left_side));
  if (factors.values.empty()) return {};
  std::vector<double> solution(unknowns, 0.0);
  for (int i = 0; i < unknowns; ++i) {
    if (factors.values[i] < 1e-10 * factors.values[0]) break;
    double projection = 0;
    for (int row = 0; row < triangle.rows; ++row) projection += factors.left(row, i) * triangle(row, unknowns);
    for (int j = 0; j < unknowns; ++j) {
      solution[j] += projection / factors.values[i] * factors.right_transposed(i, j);
    }
  }
  return solution;
}

std::vector<double> residuals(const DenseMatrix& equations, const std::vector<double>& solution) {
  const int unknowns = equations.columns - 1;
  std::vector<double> result;
  for (int row = 0; row < equations.rows; ++row) result.push_back(equations(row, unknowns));
  for (int j = 0; j < unknowns; ++j) {
    for (int row = 0; row < equations.rows; ++row) result[row] -= equations(row, j) * solution[j];
  }
  return result;
}

/// Square roots of Huber's weights: 1 up to some standard deviations, which the median tells, then falling.
std::vector<double> weights_of(const std::vector<double>& residuals) {
  std::vector<double> sizes;
  for (const double residual : residuals) sizes.push_back(std::abs(residual));
  const double limit = kHuberLimit * kDeviationOfMedian * median(sizes);
  for (double& size : sizes) size = limit > 0 && size > limit ? std::sqrt(limit / size) : 1;
  return sizes;
}

/// Coefficients a (order), then b (order); empty if the equations have no solution.
std::vector<double> fit(std::span<const double> source, std::span<const double> response, int order, double& misfit) {
  const double source_scale = root_mean_square(source), response_scale = root_mean_square(response);
  if (source_scale == 0 || response_scale == 0) return {};
  const DenseMatrix equations = regression(source, source_scale, response, response_scale, order);
  std::vector<double> weights(equations.rows, 1.0), solution;
  for (int pass = 0; pass < kHuberPasses; ++pass) {
    solution = solve(equations, weights);
    if (solution.empty()) return {};
    const std::vector<double> left = residuals(equations, solution);
    misfit = root_mean_square(left);
    weights = weights_of(left);
  }
  for (int k = 0; k < order; ++k) solution[order + k] *= response_scale / source_scale;
  return solution;
}

using Complex = std::complex<double>;

Complex polynomial(std::span<const double> coefficients, Complex delay) {
  Complex value = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) value = value * delay + coefficients[k];
  return value;
}

/// A fitted system H = B / A with B = sum_k b_k z^-k, A = 1 - sum_k a_k z^-k.
struct Model {
  std::vector<double> a, b;
  double rate = 0;  // [Hz]

  Complex numerator(Complex z) const { return polynomial(b, 1.0 / z); }
  Complex denominator(Complex z) const { return 1.0 - polynomial(a, 1.0 / z) / z; }
  /// |H| [dB] at a frequency [Hz]
  double level(double frequency) const {
    const Complex z = std::polar(1.0, 2 * std::numbers::pi * frequency / rate);
    return 20 * std::log10(std::abs(numerator(z) / denominator(z)));
  }
};

/// Whether |H| has a maximum no further from a resonance than half of its bandwidth, or than the bins of 1 Hz tell.
bool shows_peak(std::span<const double> level, const Formant& formant) {
  const double reach = std::max(0.5 * formant.bandwidth, 1.0);
  const auto first = static_cast<std::size_t>(std::max(std::ceil(formant.frequency - reach), 1.0));
  const double last = std::floor(formant.frequency + reach);
  for (std::size_t bin = first; bin + 1 < level.size() && static_cast<double>(bin) <= last; ++bin) {
    if (level[bin] > level[bin - 1] && level[bin] >= level[bin + 1]) return true;
  }
  return false;
}

/// The resonances of one model that shape |H| at their own frequency; the others are fitted to noise or to skirts.
/// level  |H|, 1 Hz apart from 0 [dB]
std::vector<SeenFormant> resonances(const Model& model, std::span<const double> level, int order,
                                    const DrivenModel& settings) {
  std::vector<double> coefficients;
  for (const double value : model.a) coefficients.push_back(-value);
  const std::vector<Complex> poles = polynomial_roots(coefficients);
  std::vector<SeenFormant> result;
  for (const Complex& pole : poles) {
    if (pole.imag() <= 0) continue;
    // A pole without losses may come out on the wrong side of the unit circle.
    const double radius = std::min(std::abs(pole), 1 / std::abs(pole));
    Formant formant;
    formant.frequency = std::arg(pole) * model.rate / (2 * std::numbers::pi);
    formant.bandwidth = -std::log(radius) * model.rate / std::numbers::pi;
    formant.level = model.level(formant.frequency);
    if (formant.frequency < settings.minimum_frequency || formant.frequency > 0.45 * model.rate) continue;
    if (formant.bandwidth > settings.maximum_bandwidth) continue;
    // H = ... + residue / (1 - pole / z): at the pole's own frequency |residue| / (1 - radius).
    Complex others = 1;
    for (const Complex& other : poles) {
      if (&other != &pole) others *= 1.0 - other / pole;
    }
    const double own = 20 * std::log10(std::abs(model.numerator(pole) / others) / (1 - radius));
    if (own > formant.level + settings.least_own_level) {
      result.push_back({formant, order, shows_peak(level, formant)});
    }
  }
  return result;
}

/// The median over the models at each frequency, then the mean over 9 Hz: medians have steps.
std::vector<double> combine(const std::vector<std::vector<double>>& levels) {
  const std::size_t bins = levels.front().size();
  std::vector<double> middle(bins), result(bins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    std::vector<double> values;
    for (const auto& level : levels) values.push_back(level[bin]);
    middle[bin] = median(std::move(values));
  }
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t first = bin < 4 ? 0 : bin - 4, last = std::min(bin + 4, bins - 1);
    for (std::size_t i = first; i <= last; ++i) result[bin] += middle[i] / static_cast<double>(last - first + 1);
  }
  return result;
}

}  // namespace

DrivenResponse driven_response(std::span<const double> source, std::span<const double> response, double rate,
                               const DrivenModel& model) {
  DrivenResponse result;
  if (response.size() / rate * model.sampling_rate < 6 * model.highest_order) return result;
  const std::vector<double> q = without_mean(resample(source, rate, model.sampling_rate));
  const std::vector<double> p = without_mean(resample(response, rate, model.sampling_rate));
  const std::size_t length = std::min(p.size(), q.size());
  // The resampling filter stops the last tenth below half the sampling rate.
  const int highest = static_cast<int>(0.45 * model.sampling_rate);
  std::vector<std::vector<double>> levels;
  std::vector<SeenFormant> seen;
  for (int order = model.lowest_order; order <= model.highest_order; order += 2) {
    const std::vector<double> fitted =
        fit(std::span(q).first(length), std::span(p).first(length), order, result.misfit);
    if (fitted.empty()) continue;
    const Model system = {
        {fitted.begin(), fitted.begin() + order}, {fitted.begin() + order, fitted.end()}, model.sampling_rate};
    std::vector<double> level;
    for (int hertz = 0; hertz <= highest; ++hertz) level.push_back(system.level(hertz));
    const std::vector<SeenFormant> found = resonances(system, level, order, model);
    seen.insert(seen.end(), found.begin(), found.end());
    levels.push_back(std::move(level));
  }
  if (levels.empty()) return result;
  result.level = combine(levels);
  for (int hertz = 0; hertz <= highest; ++hertz) result.frequency.push_back(hertz);
  result.formants = recurring_formants(seen, static_cast<int>(levels.size()), model.agreement);
  return result;
}

}  // namespace vocalis::acoustic
