#pragma once

#include <string>
#include <vector>

#include "acoustic_solver/signals/cubic_spline.hpp"

namespace vocalis::acoustic {

/// A flux as it was recorded or computed elsewhere.
struct RecordedSignal {
  std::string file;            ///< where it came from, for messages
  std::vector<double> times;   ///< [s], increasing; the first one need not be 0
  std::vector<double> values;  ///< flux at these times [m^3/s], or [m/s] of a velocity
  double fade = 0;             ///< [s] over which the signal rises at its beginning and falls at its end
};

/// A recorded signal ready for use: the cubic spline through its samples, whose first two derivatives are continuous,
/// times (1 - cos(pi t / fade)) / 2 at both ends; zero before and after. The first sample sounds at time 0.
class RecordedFlux {
 public:
  /// Throws UserError if there are fewer than four samples, a time does not increase, a number is not finite, all
  /// values are zero, the record is shorter than two fades, or it begins or ends with a step of more than 1e-3 of its
  /// greatest value, which would be a click.
  explicit RecordedFlux(const RecordedSignal& settings);
  double value(double time) const;          ///< [unit of the values]
  double rate(double time) const;           ///< its derivative [unit of the values per second]
  double end() const { return duration_; }  ///< from here on silent [s]

 private:
  double gain(double time) const;
  double gain_rate(double time) const;

  double first_;
  double duration_;
  double fade_;
  CubicSpline spline_;
};

}  // namespace vocalis::acoustic
