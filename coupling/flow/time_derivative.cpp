#include "coupling/flow/time_derivative.hpp"

#include <algorithm>
#include <cassert>

namespace vocalis::coupling {

namespace {

/// Adds weight (q - p) / (t_q - t_p).
void add_secant(double weight, const FlowSnapshot& p, const FlowSnapshot& q, std::vector<double>& rates) {
  const double factor = weight / (q.time - p.time);
  for (std::size_t v = 0; v < rates.size(); ++v) rates[v] += factor * (q.pressure[v] - p.pressure[v]);
}

}  // namespace

int lag_of(PressureDerivative derivative) { return derivative == PressureDerivative::five_point ? 2 : 0; }

int snapshots_for(PressureDerivative derivative) {
  switch (derivative) {
    case PressureDerivative::step:
      return 2;
    case PressureDerivative::bdf2:
      return 4;
    case PressureDerivative::five_point:
      return 6;
  }
  return 2;
}

std::vector<double> pressure_rate(const std::deque<FlowSnapshot>& snapshots, int at, PressureDerivative derivative) {
  const int last = static_cast<int>(snapshots.size()) - 1;
  assert(last >= 1 && at >= 0 && at <= last);
  std::vector<double> rates(snapshots[at].pressure.size(), 0.0);
  if (derivative == PressureDerivative::five_point) {
    for (const int reach : {1, 2}) {
      add_secant(0.5, snapshots[std::max(at - reach, 0)], snapshots[std::min(at + reach, last)], rates);
    }
  } else if (at < 2) {
    add_secant(1, snapshots[0], snapshots[1], rates);
  } else {
    // The slope of the parabola through three points, from the secants of the last step and of both.
    const double step = snapshots[at].time - snapshots[at - 1].time;
    const double before = snapshots[at - 1].time - snapshots[at - 2].time;
    add_secant(1 + step / (step + before), snapshots[at - 1], snapshots[at], rates);
    add_secant(-step / (step + before), snapshots[at - 2], snapshots[at - 1], rates);
  }
  return rates;
}

}  // namespace vocalis::coupling
