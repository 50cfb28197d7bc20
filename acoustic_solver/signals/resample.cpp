#include "acoustic_solver/signals/resample.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "acoustic_solver/signals/cubic_spline.hpp"
#include "core/base/error.hpp"

namespace vocalis::acoustic {

namespace {

constexpr double kaiser_beta = 10.06;    // Kaiser 1974: 100 dB need 0.1102 (100 - 8.7)
constexpr int points_per_sample = 2048;  // linear interpolation in the table is then exact to 3e-7

/// Low-pass kernel h(x) as a table; x in samples at the lower rate, h even and zero beyond half_width.
class Kernel {
 public:
  /// pass_edge  where the transition to the Nyquist frequency begins, in Nyquist frequencies
  explicit Kernel(double pass_edge)
      // A transition as wide as 0.1 needs (100 - 7.95) / (14.36 * 0.05) = 128 samples at the lower rate, half of them
      // on each side (Kaiser 1974).
      : half_width_(static_cast<int>(std::ceil(6.5 / (1 - pass_edge) - 1e-9))),
        table_(static_cast<std::size_t>(half_width_ * points_per_sample + 2), 0.0) {
    const double cutoff = 0.5 * (1 + pass_edge);  // middle of the transition, in Nyquist frequencies
    for (int i = 0; i < half_width_ * points_per_sample; ++i) {
      const double x = static_cast<double>(i) / points_per_sample;
      const double angle = std::numbers::pi * cutoff * x;
      const double sinc = i == 0 ? 1.0 : std::sin(angle) / angle;
      const double ratio = x / half_width_;
      table_[static_cast<std::size_t>(i)] =
          cutoff * sinc * bessel_i0(kaiser_beta * std::sqrt(1 - ratio * ratio)) / bessel_i0(kaiser_beta);
    }
  }

  int half_width() const { return half_width_; }

  double operator()(double x) const {
    const double place = std::abs(x) * points_per_sample;
    const auto index = static_cast<std::size_t>(place);
    if (index + 1 >= table_.size()) return 0;
    const double part = place - static_cast<double>(index);
    return (1 - part) * table_[index] + part * table_[index + 1];
  }

 private:
  static double bessel_i0(double x) {
    double sum = 1;
    double term = 1;
    for (int k = 1; term > 1e-17 * sum; ++k) {
      term *= (x / (2 * k)) * (x / (2 * k));
      sum += term;
    }
    return sum;
  }

  int half_width_;
  std::vector<double> table_;
};

const Kernel& usual_kernel() {
  static const Kernel kernel(0.9);
  return kernel;
}

/// Value at an index that may lie outside: point reflection about the first or the last sample, once; constant further.
double reflected(std::span<const double> values, std::int64_t index) {
  const auto last = static_cast<std::int64_t>(values.size()) - 1;
  const auto at = [&](std::int64_t i) {
    return values[static_cast<std::size_t>(std::clamp<std::int64_t>(i, 0, last))];
  };
  if (index < 0) return 2 * values.front() - at(-index);
  if (index > last) return 2 * values.back() - at(2 * last - index);
  return at(index);
}

std::vector<double> resample(std::span<const double> values, double rate, double target_rate, double lower_rate,
                             const Kernel& kernel) {
  assert(rate > 0 && target_rate > 0);
  std::vector<double> result;
  if (values.empty()) return result;
  const double duration = static_cast<double>(values.size() - 1) / rate;
  const auto count = static_cast<std::int64_t>(std::floor(duration * target_rate + 1e-6)) + 1;
  result.reserve(static_cast<std::size_t>(count));
  const double scale = lower_rate / rate;  // samples at the lower rate per sample of the series
  const auto last = static_cast<std::int64_t>(values.size()) - 1;
  for (std::int64_t k = 0; k < count; ++k) {
    const double place = static_cast<double>(k) * rate / target_rate;
    const auto begin = static_cast<std::int64_t>(std::ceil(place - kernel.half_width() / scale));
    const auto end = static_cast<std::int64_t>(std::floor(place + kernel.half_width() / scale));
    const bool inside = begin >= 0 && end <= last;
    double sum = 0;
    for (std::int64_t n = begin; n <= end; ++n) {
      const double value = inside ? values[static_cast<std::size_t>(n)] : reflected(values, n);
      sum += value * kernel((place - static_cast<double>(n)) * scale);
    }
    result.push_back(scale * sum);
  }
  return result;
}

}  // namespace

std::vector<double> resample(std::span<const double> values, double rate, double target_rate) {
  return resample(values, rate, target_rate, std::min(rate, target_rate), usual_kernel());
}

std::vector<double> resample_sharply(std::span<const double> values, double rate, double target_rate) {
  static const Kernel kernel(0.98);
  return resample(values, rate, target_rate, std::min(rate, target_rate), kernel);
}

std::vector<double> spline_to_uniform(std::span<const double> times, std::span<const double> values, double step,
                                      int count) {
  assert(times.size() == values.size() && times.size() >= 2);
  const CubicSpline spline(times, values);
  std::vector<double> result(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) result[static_cast<std::size_t>(k)] = spline.value(times[0] + k * step);
  return result;
}

std::vector<double> resample(std::span<const double> times, std::span<const double> values, double target_rate) {
  assert(times.size() == values.size());
  if (times.size() < 2) return {values.begin(), values.end()};
  const double duration = times.back() - times.front();
  const double mean_step = duration / static_cast<double>(times.size() - 1);
  double smallest = mean_step;
  double largest = mean_step;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double step = times[i] - times[i - 1];
    if (!(step > 0)) {
      throw base::UserError("the times of a series must increase",
                            fmt::format("{} s after {} s", times[i], times[i - 1]),
                            "sort the rows by time and drop those that are there twice");
    }
    smallest = std::min(smallest, step);
    largest = std::max(largest, step);
  }
  const double mean_rate = 1 / mean_step;
  if (largest - smallest <= 1e-6 * mean_step) return resample(values, mean_rate, target_rate);
  const double step = std::max(smallest, mean_step / 16);
  const int count = static_cast<int>(std::floor(duration / step * (1 + 1e-12))) + 1;
  const std::vector<double> uniform = spline_to_uniform(times, values, step, count);
  std::vector<double> result =
      resample(uniform, 1 / step, target_rate, std::min(mean_rate, target_rate), usual_kernel());
  return result;
}

}  // namespace vocalis::acoustic
