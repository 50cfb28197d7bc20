#include "coupling/clock.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::coupling {

namespace {

constexpr double safety = 0.9, largest_growth = 1.5, largest_cut = 0.3;
constexpr double no_cut_above = 0.85, no_growth_below = 1.2;
constexpr int steps_before_growth = 8;

}  // namespace

double Clock::dt() const {
  const double chosen = adaptive_step > 0 ? adaptive_step : nominal_step;
  const double step_size = chosen / static_cast<double>(1L << halvings);
  const double remainder = end - time;
  // What is left is one step, or two equal ones, rather than a whole step and a sliver: rates over a sliver are noise.
  if (remainder < step_size * (1 + 1e-9)) return remainder;
  return remainder < 2 * step_size ? remainder / 2 : step_size;
}

bool Clock::can_shrink() const { return dt() / 2 >= smallest_step && halvings < 30; }

void Clock::shrink() {
  const double refused = dt();
  if (tolerance > 0) {
    adaptive_step = refused / 2;
    steps_to_wait = steps_before_growth;
  } else {
    // The last step may be shorter than the halved one already.
    do ++halvings;
    while (dt() > 0.75 * refused && halvings < 30);
  }
  ++rejected;
  accepted_in_a_row = 0;
}

bool Clock::is_too_coarse(double local_error) const {
  return tolerance > 0 && local_error > 2 * tolerance && dt() > smallest_step * (1 + 1e-9);
}

void Clock::refine(double local_error) {
  const double factor = std::max(largest_cut, safety * std::cbrt(tolerance / local_error));
  adaptive_step = std::max(smallest_step, factor * dt());
  steps_to_wait = std::max(steps_to_wait, 1);
  ++rejected;
  accepted_in_a_row = 0;
}

void Clock::advance(double dt, double local_error) {
  time += dt;
  ++step;
  ++accepted_in_a_row;
  if (tolerance > 0) {
    if (local_error > 0) adapt(dt, local_error);
  } else if (halvings > 0 && accepted_in_a_row >= steps_before_growth) {
    --halvings;
    accepted_in_a_row = 0;
  }
}

void Clock::adapt(double dt, double local_error) {
  const double before = last_error > 0 ? last_error : local_error;
  last_error = local_error;
  double factor = safety * std::cbrt(tolerance / local_error) * std::pow(before / local_error, 1.0 / 15);
  if (accepted_in_a_row <= steps_to_wait) {
    factor = std::min(factor, 1.0);
  } else {
    steps_to_wait = 0;
  }
  const double wanted = dt * std::clamp(factor, largest_cut, largest_growth);
  const double chosen = std::clamp(wanted, smallest_step, largest_step);
  if (chosen > no_cut_above * dt && chosen < no_growth_below * dt) return;
  adaptive_step = chosen;
}

}  // namespace vocalis::coupling
