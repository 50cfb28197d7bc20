#pragma once

#include <span>
#include <vector>

namespace vocalis::acoustic {

/// Changes the sampling rate of an equally spaced series by a windowed sinc (Kaiser window, 100 dB) of linear phase,
/// without delay: sample k of the result is at k / target_rate after the first sample of the series. With the lower
/// Nyquist frequency f_N of the two rates, everything below 0.9 f_N passes and everything above f_N is stopped.
/// Past its ends the series is continued by point reflection, which keeps its value and slope there.
///
/// rate, target_rate  [Hz], > 0
/// Source: Smith 1984 (bandlimited interpolation); window of Kaiser 1974.
std::vector<double> resample(std::span<const double> values, double rate, double target_rate);

/// The same with everything below 0.98 f_N passing, by a kernel five times as long: for linear prediction, whose poles
/// would be drawn to the edge of an empty band.
std::vector<double> resample_sharply(std::span<const double> values, double rate, double target_rate);

/// The same as `resample` for a series with time stamps. Unless they are equally spaced (to 1e-6 of a step), a cubic
/// spline first takes the series to a uniform grid as fine as its smallest step, but at most 16 times finer than its
/// mean step.
///
/// times   increasing [s], as many as `values`
/// Throws UserError if the times do not increase.
std::vector<double> resample(std::span<const double> times, std::span<const double> values, double target_rate);

/// The CubicSpline through (times, values) at equally spaced times first + k step, k = 0 .. count - 1.
std::vector<double> spline_to_uniform(std::span<const double> times, std::span<const double> values, double step,
                                      int count);

}  // namespace vocalis::acoustic
