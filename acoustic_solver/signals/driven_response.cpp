#include "acoustic_solver/signals/driven_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "acoustic_solver/signals/dense.hpp"
#include "acoustic_solver/signals/resample.hpp"

namespace vocalis::acoustic {

namespace {

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

/// Coefficients a (order), then b (order); empty if the equations have no solution.
std::vector<double> fit(std::span<const double> source, std::span<const double> response, int order, double& misfit) {
  const int rows = static_cast<int>(response.size()) - order;
  DenseMatrix equations(rows, 2 * order);
  const double source_scale = root_mean_square(source), response_scale = root_mean_square(response);
  if (source_scale == 0 || response_scale == 0) return {};
  for (int row = 0; row < rows; ++row) {
    const int n = row + order;
    for (int k = 0; k < order; ++k) {
      equations(row, k) = response[n - 1 - k] / response_scale;
      equations(row, order + k) = source[n - k] / source_scale;
    }
  }
  const SingularValues factors = singular_values(equations);
  if (factors.values.empty()) return {};
  std::vector<double> solution(2 * order, 0.0);
  for (int i = 0; i < 2 * order; ++i) {
    if (factors.values[i] < 1e-10 * factors.values[0]) break;
    double projection = 0;
    for (int row = 0; row < rows; ++row) projection += factors.left(row, i) * response[row + order] / response_scale;
    for (int j = 0; j < 2 * order; ++j) solution[j] += projection / factors.values[i] * factors.right_transposed(i, j);
  }
  double squares = 0;
  for (int row = 0; row < rows; ++row) {
    double left = response[row + order] / response_scale;
    for (int j = 0; j < 2 * order; ++j) left -= equations(row, j) * solution[j];
    squares += left * left;
  }
  misfit = std::sqrt(squares / rows);
  for (int k = 0; k < order; ++k) solution[order + k] *= response_scale / source_scale;
  return solution;
}

std::complex<double> polynomial(std::span<const double> coefficients, std::complex<double> delay) {
  std::complex<double> value = 0;
  for (std::size_t k = coefficients.size(); k-- > 0;) value = value * delay + coefficients[k];
  return value;
}

/// |B/A| [dB] at whole hertz of a model of one order; empty if it could not be fitted.
std::vector<double> level_of_order(std::span<const double> source, std::span<const double> response, int order,
                                   double rate, int highest, double& misfit) {
  const std::vector<double> coefficients = fit(source, response, order, misfit);
  if (coefficients.empty()) return {};
  const std::span<const double> a = std::span(coefficients).first(order), b = std::span(coefficients).subspan(order);
  std::vector<double> level;
  for (int hertz = 0; hertz <= highest; ++hertz) {
    const auto delay = std::polar(1.0, -2 * std::numbers::pi * hertz / rate);
    level.push_back(20 * std::log10(std::abs(polynomial(b, delay) / (1.0 - delay * polynomial(a, delay)))));
  }
  return level;
}

/// The median over the models at each frequency, then the mean over 9 Hz: medians have steps.
std::vector<double> combine(const std::vector<std::vector<double>>& levels) {
  const std::size_t bins = levels.front().size();
  std::vector<double> median(bins), result(bins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    std::vector<double> values;
    for (const auto& level : levels) values.push_back(level[bin]);
    std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
    median[bin] = values[values.size() / 2];
  }
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t first = bin < 4 ? 0 : bin - 4, last = std::min(bin + 4, bins - 1);
    for (std::size_t i = first; i <= last; ++i) result[bin] += median[i] / static_cast<double>(last - first + 1);
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
  for (int order = model.lowest_order; order <= model.highest_order; order += 2) {
    std::vector<double> level = level_of_order(std::span(q).first(length), std::span(p).first(length), order,
                                               model.sampling_rate, highest, result.misfit);
    if (!level.empty()) levels.push_back(std::move(level));
  }
  if (levels.empty()) return result;
  result.level = combine(levels);
  for (int hertz = 0; hertz <= highest; ++hertz) result.frequency.push_back(hertz);
  result.formants = formants_by_peaks(result.level, 1.0,
                                      {.minimum_frequency = model.minimum_frequency,
                                       .maximum_frequency = static_cast<double>(highest),
                                       .prominence = model.prominence});
  return result;
}

}  // namespace vocalis::acoustic
