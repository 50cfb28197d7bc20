#pragma once

#include <cmath>
#include <vector>

namespace vocalis::coupling::test {

/// Samples of a function at uneven times: steps of 0.8 and 1.2 times `step` in turn.
struct Samples {
  std::vector<double> times, values;
};

template <class Function>
Samples sample(const Function& function, double end, double step) {
  Samples samples;
  double time = 0;
  for (int n = 0; time <= end; ++n) {
    samples.times.push_back(time);
    samples.values.push_back(function(time));
    time += (n % 2 ? 0.8 : 1.2) * step;
  }
  return samples;
}

/// Pulses that rise and fall on straight lines, then rest: all times [s].
struct Triangle {
  double rise = 3e-3, fall = 1.5e-3, period = 8e-3;
  double height = 2;

  double operator()(double time) const {
    const double t = std::fmod(time, period);
    if (t < rise) return height * t / rise;
    return t < rise + fall ? height * (rise + fall - t) / fall : 0;
  }
};

}  // namespace vocalis::coupling::test
