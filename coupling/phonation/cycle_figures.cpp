#include "coupling/phonation/cycle_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "coupling/statistics.hpp"

namespace vocalis::coupling {

namespace {

using Series = std::span<const double>;

constexpr double declination_interval = 2e-4;  // [s]
constexpr double wide = 0.2;                   // of the range of the opening

std::optional<double> largest(Series times, Series values, double begin, double end) {
  std::optional<double> result;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (times[i] < begin || times[i] > end) continue;
    if (!result || values[i] > *result) result = values[i];
  }
  return result;
}

/// Of the polygon through the samples.
double mean(Series times, Series values, double begin, double end) {
  double sum = 0, time = begin, value = linear_at(times, values, begin);
  const auto advance = [&](double next, double there) {
    sum += 0.5 * (next - time) * (value + there);
    time = next;
    value = there;
  };
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] > begin && times[i] < end) advance(times[i], values[i]);
  }
  advance(end, linear_at(times, values, end));
  return sum / (end - begin);
}

/// Time in [begin, end] for which the polygon through the samples is above a level.
double time_above(Series times, Series values, double begin, double end, double level) {
  double sum = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double t0 = std::max(times[i - 1], begin), t1 = std::min(times[i], end);
    if (t1 <= t0) continue;
    const double v0 = linear_at(times, values, t0) - level, v1 = linear_at(times, values, t1) - level;
    const double high = std::max(v0, v1), low = std::min(v0, v1);
    if (high > 0) sum += (t1 - t0) * (low >= 0 ? 1 : high / (high - low));
  }
  return sum;
}

/// A sample tells of the step that ended there: the opening is 0 if the glottis was sealed during the whole of it.
std::optional<double> largest_leak(const PhonationSeries& series, double begin, double end) {
  std::optional<double> leak;
  for (std::size_t i = 0; i < series.times.size(); ++i) {
    if (series.times[i] < begin || series.times[i] > end) continue;
    if (series.opening[i] > 0) continue;
    leak = std::max(leak.value_or(0), std::abs(series.glottal_flow[i]));
  }
  return leak;
}

}  // namespace

double flow_declination(Series times, Series flow, double begin, double end) {
  double steepest = 0;
  for (const double time : times) {
    if (time < begin || time > end) continue;
    const double before = std::max(time - 0.5 * declination_interval, times.front());
    const double after = std::min(time + 0.5 * declination_interval, times.back());
    if (after <= before) continue;
    steepest = std::max(steepest, (linear_at(times, flow, before) - linear_at(times, flow, after)) / (after - before));
  }
  return steepest;
}

CycleFigures measure_cycle(const GlottalCycle& cycle, const PhonationSeries& series) {
  CycleFigures figures;
  figures.cycle = cycle;
  const double period = cycle.period(), begin = cycle.begin, end = cycle.end;
  const Series times = series.times;
  figures.frequency = 1 / period;
  if (cycle.closed) figures.open_quotient = (cycle.closes - cycle.opens) / period;
  const double least = extremum(times, series.opening, begin, end, -1)->value;
  const double level = least + wide * (cycle.largest_opening - least);
  figures.wide_quotient = time_above(times, series.opening, begin, end, level) / period;
  figures.closing_quotient = (cycle.closes - cycle.peak) / period;
  if (cycle.closes > cycle.peak) figures.speed_quotient = (cycle.peak - cycle.opens) / (cycle.closes - cycle.peak);
  figures.peak_speed = largest(times, series.speed, begin, end);
  figures.impact_stress = largest(times, series.impact_stress, begin, end);
  for (const Series& displacement : series.displacements) {
    const auto high = extremum(times, displacement, begin, end, 1), low = extremum(times, displacement, begin, end, -1);
    figures.amplitudes.push_back(0.5 * (high->value - low->value));
  }
  if (series.flow.empty()) return figures;
  const auto peak_flow = extremum(times, series.flow, begin, end, 1);
  figures.peak_flow = peak_flow->value;
  const double opening = linear_at(times, series.opening, peak_flow->time);
  if (opening > 0) figures.jet_speed = *figures.peak_flow / opening;
  figures.mean_flow = mean(times, series.flow, begin, end);
  figures.declination = flow_declination(times, series.flow, begin, end);
  if (series.glottal_flow.empty()) return figures;
  if (const auto leak = largest_leak(series, begin, end)) figures.leak = *leak / *figures.peak_flow;
  return figures;
}

double spread(Series values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  return (*high - *low) / mean;
}

}  // namespace vocalis::coupling
