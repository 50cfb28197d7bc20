#include "acoustic_solver/sources/recorded_signal.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

namespace vocalis::acoustic {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double largest_step = 1e-3;  // at the ends of a record, over its greatest value

void check_samples(const RecordedSignal& signal) {
  const std::vector<double>&times = signal.times, &values = signal.values;
  if (times.size() < 4 || times.size() != values.size()) {
    throw base::UserError(signal.file + ": a signal needs at least four samples", fmt::format("{}", times.size()),
                          "give a longer record, one row (time, value) a sample");
  }
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]) || !std::isfinite(values[i])) {
      throw base::UserError(signal.file + ": times and values of a signal must be finite",
                            fmt::format("sample {}: {} s, {}", i + 1, times[i], values[i]), "mend or drop that row");
    }
    if (i > 0 && !(times[i] > times[i - 1])) {
      throw base::UserError(signal.file + ": the times of a signal must increase",
                            fmt::format("sample {}: {} s after {} s", i + 1, times[i], times[i - 1]),
                            "sort the rows by time and drop those that are there twice");
    }
  }
}

void check_ends(const RecordedSignal& signal) {
  double greatest = 0;
  for (const double value : signal.values) greatest = std::max(greatest, std::abs(value));
  if (greatest == 0) {
    throw base::UserError(signal.file + ": a signal must not be silent", "zeros only",
                          "look whether column and scale are the right ones");
  }
  const double duration = signal.times.back() - signal.times.front();
  if (!(signal.fade >= 0) || 2 * signal.fade > duration) {
    throw base::UserError(signal.file + ": fade must not be negative, nor longer than half of the signal [s]",
                          fmt::format("fade {} s of a signal of {} s", signal.fade, duration), "shorten the fade");
  }
  const double step = std::max(std::abs(signal.values.front()), std::abs(signal.values.back())) / greatest;
  if (signal.fade == 0 && step > largest_step) {
    throw base::UserError(signal.file + ": a signal that does not begin and end at zero needs a fade",
                          fmt::format("{} at the beginning, {} at the end, {} at most", signal.values.front(),
                                      signal.values.back(), greatest),
                          "give fade [s], for example 0.002, or cut the record where it is silent");
  }
}

const RecordedSignal& checked(const RecordedSignal& signal) {
  check_samples(signal);
  check_ends(signal);
  return signal;
}

}  // namespace

RecordedFlux::RecordedFlux(const RecordedSignal& settings)
    : first_(checked(settings).times.front()),
      duration_(settings.times.back() - first_),
      fade_(settings.fade),
      spline_(settings.times, settings.values) {}

double RecordedFlux::gain(double time) const {
  const double from_end = std::min(time, duration_ - time);
  return from_end < fade_ ? 0.5 * (1 - std::cos(pi * from_end / fade_)) : 1;
}

double RecordedFlux::gain_rate(double time) const {
  const double from_end = std::min(time, duration_ - time);
  if (from_end >= fade_) return 0;
  const double slope = 0.5 * pi / fade_ * std::sin(pi * from_end / fade_);
  return time < duration_ - time ? slope : -slope;
}

double RecordedFlux::value(double time) const {
  if (time <= 0 || time >= duration_) return 0;
  return gain(time) * spline_.value(first_ + time);
}

double RecordedFlux::rate(double time) const {
  if (time <= 0 || time >= duration_) return 0;
  return gain(time) * spline_.rate(first_ + time) + gain_rate(time) * spline_.value(first_ + time);
}

}  // namespace vocalis::acoustic
