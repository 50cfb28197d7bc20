#pragma once

#include <span>
#include <vector>

namespace vocalis::coupling {

/// One cycle of vocal folds. It begins where the opening rises through the middle of its range and ends where it does
/// so again; the times of its pulse of air are [s], too.
struct GlottalCycle {
  double begin = 0, end = 0;
  double opens = 0;    ///< end of the closed phase before the pulse; without one, where the opening is least
  double peak = 0;     ///< where the opening is largest
  double closes = 0;   ///< begin of the closed phase after the pulse; without one, where the opening is least
  bool closed = true;  ///< whether the folds close before the pulse, and after it
  double largest_opening = 0;

  double period() const { return end - begin; }
};

/// The whole cycles of an opening, area or width, since a time. Closed is where it is 0: that is what contact makes of
/// it, so no threshold is needed. Between two samples of which one is 0 the change is taken to be in the middle.
///
/// times    [s] rising, perhaps uneven
/// opening  as many values
std::vector<GlottalCycle> glottal_cycles(std::span<const double> times, std::span<const double> opening, double begin);

/// How often the folds closed.
int count_closures(std::span<const double> opening);

}  // namespace vocalis::coupling
