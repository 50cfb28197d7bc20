#include "coupling/phonation/glottal_cycle.hpp"

#include <algorithm>

#include "coupling/statistics.hpp"

namespace vocalis::coupling {

namespace {

using Series = std::span<const double>;

struct Instant {
  double time = 0;  // [s]
  bool closed = false;
};

std::size_t first_at(Series times, double time) {
  return std::lower_bound(times.begin(), times.end(), time) - times.begin();
}

double least_time(Series times, Series opening, double begin, double end, double otherwise) {
  const auto least = extremum(times, opening, begin, end, -1);
  return least ? least->time : otherwise;
}

/// The last change from closed to open in [begin, end].
Instant opening_instant(Series times, Series opening, double begin, double end) {
  const std::size_t first = first_at(times, begin);
  for (std::size_t i = first_at(times, end); i-- > first;) {
    if (opening[i] <= 0 && i + 1 < times.size()) return {0.5 * (times[i] + times[i + 1]), true};
  }
  return {least_time(times, opening, begin, end, begin), false};
}

/// The first change from open to closed in [begin, end].
Instant closing_instant(Series times, Series opening, double begin, double end) {
  for (std::size_t i = std::max<std::size_t>(1, first_at(times, begin)); i < times.size() && times[i] <= end; ++i) {
    if (opening[i] <= 0) return {0.5 * (times[i - 1] + times[i]), true};
  }
  return {least_time(times, opening, begin, end, end), false};
}

}  // namespace

std::vector<GlottalCycle> glottal_cycles(Series times, Series opening, double begin) {
  const std::vector<double> crossings = up_crossings(times, opening, begin);
  std::vector<GlottalCycle> cycles;
  double peak_before = begin;
  for (std::size_t n = 0; n + 1 < crossings.size(); ++n) {
    GlottalCycle cycle{.begin = crossings[n], .end = crossings[n + 1]};
    const auto peak = extremum(times, opening, cycle.begin, cycle.end, 1);
    if (!peak) continue;  // no sample in there
    cycle.peak = peak->time;
    cycle.largest_opening = peak->value;
    const Instant opens = opening_instant(times, opening, peak_before, cycle.begin);
    const Instant closes = closing_instant(times, opening, cycle.peak, cycle.end);
    cycle.opens = opens.time;
    cycle.closes = closes.time;
    cycle.closed = opens.closed && closes.closed;
    peak_before = cycle.peak;
    cycles.push_back(cycle);
  }
  return cycles;
}

int count_closures(Series opening) {
  int count = 0;
  for (std::size_t i = 1; i < opening.size(); ++i) count += opening[i] <= 0 && opening[i - 1] > 0;
  return count;
}

}  // namespace vocalis::coupling
