#include "coupling/statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"

namespace vocalis::coupling {

namespace {

using Series = std::span<const double>;

constexpr double hysteresis = 0.05;  // of the amplitude
constexpr double rounding = 1e-12;   // of the mean: a smaller amplitude is none

struct Interval {
  double begin = 0, end = 0;  // [s]
  double length() const { return end - begin; }
};

struct Swing {
  double mean = 0, amplitude = 0;
};

std::optional<Swing> swing(Series times, Series values, const Interval& in) {
  const auto high = extremum(times, values, in.begin, in.end, 1), low = extremum(times, values, in.begin, in.end, -1);
  if (!high || !low) return {};
  return Swing{0.5 * (high->value + low->value), 0.5 * (high->value - low->value)};
}

/// Where the polygon through the samples rises through `middle`; see up_crossings.
std::vector<double> crossings_of(Series times, Series values, double begin, double middle, double margin) {
  std::vector<double> result;
  bool from_below = false;
  double first = 0, last = 0;  // of the crossings since the series was clearly below
  bool crossed = false;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < begin) continue;
    const double above = values[i] - middle;
    const double before = i > 0 && times[i - 1] >= begin ? values[i - 1] - middle : above;
    if (before < 0 && above >= 0) {
      last = times[i] - (times[i] - times[i - 1]) * above / (above - before);
      if (!crossed) first = last;
      crossed = true;
    }
    if (above < -margin) {
      from_below = true;
      crossed = false;
    } else if (above > margin) {
      if (from_below && crossed) result.push_back(0.5 * (first + last));
      from_below = crossed = false;
    }
  }
  return result;
}

std::vector<double> crossings_in_middle_of(const Interval& interval, Series times, Series values, double begin) {
  const auto range = swing(times, values, interval);
  if (!range || range->amplitude <= rounding * std::abs(range->mean)) return {};
  return crossings_of(times, values, begin, range->mean, hysteresis * range->amplitude);
}

/// [Hz] over as many of a column's own last periods as fit into a period.
std::optional<double> own_frequency(Series times, Series values, double begin, const Interval& period) {
  const std::vector<double> own = up_crossings(times, values, begin);
  if (own.size() < 2) return {};
  const double last_period = own.back() - own[own.size() - 2];
  const auto fit = static_cast<std::size_t>(std::max(1.0, std::round(period.length() / last_period)));
  const std::size_t count = std::min(fit, own.size() - 1);
  return static_cast<double>(count) / (own.back() - own[own.size() - 1 - count]);
}

using Results = std::map<std::string, double>;

void add_periodic(const StatisticsSettings& settings, Series times, const std::vector<MonitorColumn>& columns,
                  const std::vector<std::vector<double>>& values, Results& results) {
  const auto leading = std::find_if(columns.begin(), columns.end(),
                                    [&](const MonitorColumn& column) { return column.name() == settings.period_of; });
  if (leading == columns.end()) return;
  const std::vector<double>& leader = values[leading - columns.begin()];
  const std::vector<double> crossings = up_crossings(times, leader, settings.begin);
  if (crossings.size() < 2) return;
  const Interval period = {crossings[crossings.size() - 2], crossings.back()};
  const auto peak = extremum(times, leader, period.begin, period.end, 1);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& [stem, unit] = columns[i];
    const auto last = swing(times, values[i], period);
    if (!last) continue;
    results[stem + "_mean" + unit] = last->mean;
    results[stem + "_amplitude" + unit] = last->amplitude;
    results[stem + "_max" + unit] = last->mean + last->amplitude;
    results[stem + "_min" + unit] = last->mean - last->amplitude;
    if (const auto frequency = own_frequency(times, values[i], settings.begin, period)) {
      results[stem + "_frequency_Hz"] = *frequency;
    }
    if (crossings.size() > 2 && last->amplitude > 0) {
      const auto before = swing(times, values[i], {crossings[crossings.size() - 3], period.begin});
      if (before) results[stem + "_drift"] = (last->amplitude - before->amplitude) / last->amplitude;
    }
    if (unit == "_Pa" && peak) {
      const double half = 0.5 * period.length();
      const double time = peak->time + half <= times.back() ? peak->time + half : peak->time - half;
      results[stem + "_half_period" + unit] = linear_at(times, values[i], time);
    }
  }
}

void add_extrema(const StatisticsSettings& settings, Series times, const MonitorColumn& column, Series values,
                 Results& results) {
  for (const auto& [suffix, sign] : {std::pair("_max", 1), std::pair("_min", -1)}) {
    const auto found = extremum(times, values, settings.begin, times.back(), sign);
    if (!found) continue;
    results[column.stem + suffix + column.unit] = found->value;
    results[column.stem + suffix + "_time_s"] = found->time;
  }
}

}  // namespace

double linear_at(Series times, Series values, double time) {
  const auto after = std::lower_bound(times.begin(), times.end(), time) - times.begin();
  if (after == 0) return values.front();
  if (after == static_cast<std::ptrdiff_t>(times.size())) return values.back();
  const double part = (time - times[after - 1]) / (times[after] - times[after - 1]);
  return (1 - part) * values[after - 1] + part * values[after];
}

std::optional<Extremum> extremum(Series times, Series values, double begin, double end, int sign) {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] < begin || times[i] > end) continue;
    if (!best || sign * values[i] > sign * values[*best]) best = i;
  }
  if (!best) return {};
  const std::size_t i = *best;
  const Extremum sample = {times[i], values[i]};
  if (i == 0 || i + 1 == times.size()) return sample;
  // Newton's form of the parabola through three samples: v + (t - t_i) (slope + curvature (t - t_i)).
  const double h0 = times[i] - times[i - 1], h1 = times[i + 1] - times[i];
  const double d0 = (values[i] - values[i - 1]) / h0, d1 = (values[i + 1] - values[i]) / h1;
  const double curvature = (d1 - d0) / (h0 + h1), slope = (d0 * h1 + d1 * h0) / (h0 + h1);
  // At an end of the interval the series may go on rising: then there is no peak between the neighbours.
  if (!(sign * curvature < 0) || d0 * sign < 0 || d1 * sign > 0) return sample;
  const double shift = -slope / (2 * curvature);
  return Extremum{times[i] + shift, values[i] + 0.5 * slope * shift};
}

std::vector<double> up_crossings(Series times, Series values, double begin) {
  if (times.empty()) return {};
  std::vector<double> crossings;
  Interval interval = {begin, times.back()};
  for (int halving = 0; halving < 6 && crossings.size() < 2; ++halving) {
    crossings = crossings_in_middle_of(interval, times, values, begin);
    interval.begin += 0.5 * interval.length();
  }
  for (int refinement = 0; refinement < 4 && crossings.size() >= 2; ++refinement) {
    crossings = crossings_in_middle_of({crossings[crossings.size() - 2], crossings.back()}, times, values, begin);
  }
  return crossings;
}

Results statistics(const StatisticsSettings& settings, Series times, const std::vector<MonitorColumn>& columns,
                   const std::vector<std::vector<double>>& values) {
  Results results;
  if (times.empty()) return results;
  if (settings.kind == StatisticsKind::periodic) {
    add_periodic(settings, times, columns, values, results);
    return results;
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    results[columns[i].name()] = values[i].back();
    if (settings.kind == StatisticsKind::extrema) add_extrema(settings, times, columns[i], values[i], results);
  }
  return results;
}

void check_statistics(const StatisticsSettings& settings, const std::vector<std::string>& columns) {
  if (settings.kind != StatisticsKind::periodic) return;
  if (std::find(columns.begin(), columns.end(), settings.period_of) != columns.end()) return;
  throw base::UserError("statistics.period_of must be a column of the case's monitors",
                        "\"" + settings.period_of + "\"", base::did_you_mean(settings.period_of, columns));
}

}  // namespace vocalis::coupling
