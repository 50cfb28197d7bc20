#pragma once

#include <algorithm>

namespace vocalis::coupling {

/// Time, step and how the step shrinks after a rejection and recovers. Depends on nothing but its own history, so that
/// a resumed run takes the same steps.
struct Clock {
  double time = 0;           ///< [s]
  double end = 0;            ///< [s]
  double nominal_step = 0;   ///< dt of the case [s]
  double smallest_step = 0;  ///< below this the run has failed [s]
  long step = 0;             ///< accepted so far
  long rejected = 0;
  int halvings = 0;           ///< the current step is nominal_step / 2^halvings
  int accepted_in_a_row = 0;  ///< at this number of halvings

  bool done() const { return end - time <= 1e-9 * nominal_step; }
  double dt() const {
    const double step_size = nominal_step / static_cast<double>(1L << halvings);
    const double remainder = end - time;
    // What is left is one step, or two equal ones, rather than a whole step and a sliver: rates over a sliver are
    // noise.
    if (remainder < step_size * (1 + 1e-9)) return remainder;
    return remainder < 2 * step_size ? remainder / 2 : step_size;
  }
  bool can_shrink() const { return dt() / 2 >= smallest_step && halvings < 30; }
  void shrink() {
    const double refused = dt();
    // The last step may be shorter than the halved one already.
    do ++halvings;
    while (dt() > 0.75 * refused && halvings < 30);
    ++rejected;
    accepted_in_a_row = 0;
  }
  void advance(double dt) {
    time += dt;
    ++step;
    if (halvings > 0 && ++accepted_in_a_row >= 8) {
      --halvings;
      accepted_in_a_row = 0;
    }
  }
};

}  // namespace vocalis::coupling
