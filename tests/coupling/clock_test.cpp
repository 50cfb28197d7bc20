#include "coupling/clock.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using vocalis::coupling::Clock;

namespace {

Clock clock_of(double end, double step) {
  Clock clock;
  clock.end = end;
  clock.nominal_step = step;
  clock.smallest_step = step / 64;
  return clock;
}

Clock adaptive_clock(double end, double step, double tolerance) {
  Clock clock = clock_of(end, step);
  clock.smallest_step = 1e-6 * step;
  clock.largest_step = 10 * step;
  clock.tolerance = tolerance;
  return clock;
}

/// y' = -2 t y² by Heun's method, of second order. The exact solution through (t, y) is 1 / (t² - t² + 1/y), so that
/// the local error of each step is known; from (-6, 1/37) it is a peak of height 1 at 0.
struct Peak {
  double time = -6, value = 1.0 / 37;
  std::vector<double> steps, errors, times;  // of the accepted steps

  static double rate(double t, double y) { return -2 * t * y * y; }
  void run(Clock& clock) {
    while (!clock.done()) {
      const double dt = clock.dt();
      const double slope = rate(time, value);
      const double next = value + dt / 2 * (slope + rate(time + dt, value + dt * slope));
      const double exact = 1 / ((time + dt) * (time + dt) + 1 / value - time * time);
      const double error = std::abs(next - exact);
      if (clock.is_too_coarse(error)) {
        clock.refine(error);
        continue;
      }
      clock.advance(dt, error);
      time += dt;
      value = next;
      steps.push_back(dt), errors.push_back(error), times.push_back(time);
    }
  }
};

int changes_in(const std::vector<double>& steps) {
  int count = 0;
  for (std::size_t i = 1; i < steps.size(); ++i) count += steps[i] != steps[i - 1];
  return count;
}

/// The steps that a clock takes to the end when none is rejected.
std::vector<double> steps_of(Clock clock) {
  std::vector<double> steps;
  while (!clock.done()) {
    steps.push_back(clock.dt());
    clock.advance(clock.dt());
  }
  return steps;
}

}  // namespace

TEST_CASE("a run of whole steps takes them all, whatever the rounding of their sum", "[serial]") {
  for (const int count : {1, 2, 3, 10, 777, 30000}) {
    for (const double step : {1e-5, 2.5e-5, 1.0 / 3}) {
      const auto steps = steps_of(clock_of(count * step, step));
      CHECK(steps.size() == static_cast<std::size_t>(count));
      for (const double dt : steps) CHECK(dt == Approx(step).epsilon(1e-6));
    }
  }
}

TEST_CASE("no step at the end is a sliver: the last two share what is left", "[serial]") {
  for (const double part : {1e-8, 1e-3, 0.2, 0.5, 0.999}) {
    const Clock clock = clock_of(10 + part, 1);
    const auto steps = steps_of(clock);
    REQUIRE(steps.size() == 11);
    double sum = 0;
    for (const double dt : steps) {
      CHECK(dt > 0.5);
      CHECK(dt < 1 + 1e-7);
      sum += dt;
    }
    CHECK(sum == Approx(10 + part).epsilon(1e-12));
    CHECK(steps[9] == Approx(steps[10]));
  }
  CHECK(steps_of(clock_of(0.3, 1)) == std::vector<double>{0.3});
}

TEST_CASE("a rejected step is halved, and grows again after eight accepted ones", "[serial]") {
  Clock clock = clock_of(100, 1);
  clock.advance(clock.dt());
  clock.shrink();
  clock.shrink();
  CHECK(clock.dt() == 0.25);
  CHECK(clock.rejected == 2);
  for (int i = 0; i < 8; ++i) {
    CHECK(clock.dt() == 0.25);
    clock.advance(clock.dt());
  }
  for (int i = 0; i < 8; ++i) {
    CHECK(clock.dt() == 0.5);
    clock.advance(clock.dt());
  }
  CHECK(clock.dt() == 1);
  for (int i = 0; i < 20; ++i) clock.advance(clock.dt());
  CHECK(clock.dt() == 1);
  CHECK(clock.step == 37);
  CHECK(clock.time == 27);
}

TEST_CASE("a rejection starts the count of accepted steps anew", "[serial]") {
  Clock clock = clock_of(100, 1);
  clock.shrink();
  for (int i = 0; i < 7; ++i) clock.advance(clock.dt());
  clock.shrink();
  for (int i = 0; i < 7; ++i) clock.advance(clock.dt());
  CHECK(clock.dt() == 0.25);
  clock.advance(clock.dt());
  CHECK(clock.dt() == 0.5);
}

TEST_CASE("the step is not halved below the smallest", "[serial]") {
  Clock clock = clock_of(100, 1);
  int halvings = 0;
  for (; clock.can_shrink(); ++halvings) clock.shrink();
  CHECK(halvings == 6);
  CHECK(clock.dt() == 1.0 / 64);
}

TEST_CASE("a rejected last step becomes shorter, too", "[serial]") {
  for (const double left : {0.01, 0.3, 0.9, 1.1, 1.9}) {
    Clock clock = clock_of(100 + left, 1);
    clock.time = 100;
    while (clock.can_shrink()) {
      const double refused = clock.dt();
      clock.shrink();
      CHECK(clock.dt() <= 0.75 * refused);
    }
    CHECK(clock.dt() < 2.0 / 64);
  }
}

TEST_CASE("an adaptive step follows the local error of a known solution", "[serial]") {
  double final_error[2];
  int i = 0;
  for (const double tolerance : {1e-5, 1e-7}) {
    Clock clock = adaptive_clock(12, 0.05, tolerance);
    Peak peak;
    peak.run(clock);
    CHECK(clock.time == Approx(12).epsilon(1e-12));
    CHECK(clock.step == static_cast<long>(peak.steps.size()));
    for (std::size_t n = 0; n < peak.steps.size(); ++n) {
      CHECK(peak.errors[n] <= 2 * tolerance);
      if (n > 0 && n + 2 < peak.steps.size()) {
        const double ratio = peak.steps[n] / peak.steps[n - 1];
        const bool changed_enough = ratio == 1 || ratio <= 0.85 || ratio >= 1.2 || peak.steps[n] == 0.5;
        CHECK(changed_enough);
        CHECK(ratio < 1.5 + 1e-12);
      }
    }
    CHECK(changes_in(peak.steps) < static_cast<int>(peak.steps.size()) / 3);
    final_error[i++] = std::abs(peak.value - 1.0 / 37);
  }
  // The error at the end goes with the tolerance to the power 2/3.
  CHECK(final_error[1] < 0.15 * final_error[0]);
}

TEST_CASE("a step whose local error is constant is found in a few steps and kept", "[serial]") {
  for (const double first : {0.001, 0.03, 1.0}) {
    Clock clock = adaptive_clock(20, first, 1e-4);
    clock.largest_step = 1;
    std::vector<double> steps;
    while (!clock.done()) {
      const double dt = clock.dt(), error = 1e-4 * std::pow(dt / 0.05, 3);
      if (clock.is_too_coarse(error)) {
        clock.refine(error);
        continue;
      }
      clock.advance(dt, error);
      steps.push_back(dt);
    }
    REQUIRE(steps.size() > 100);
    CHECK(changes_in(steps) < 20);
    for (std::size_t n = 20; n + 2 < steps.size(); ++n) {
      CHECK(steps[n] == steps[20]);
      CHECK(steps[n] > 0.03);
      CHECK(steps[n] < 0.055);
    }
  }
}

TEST_CASE("an adaptive step stays between the smallest and the largest", "[serial]") {
  Clock clock = adaptive_clock(100, 1, 1e-3);
  clock.largest_step = 2;
  clock.smallest_step = 0.25;
  for (int n = 0; n < 10; ++n) clock.advance(clock.dt(), 1e-12);
  CHECK(clock.dt() == 2);
  while (clock.is_too_coarse(1)) clock.refine(1);
  CHECK(clock.dt() == 0.25);
  CHECK_FALSE(clock.is_too_coarse(1));
  clock.advance(clock.dt(), 1);
  CHECK(clock.dt() == 0.25);
}

TEST_CASE("a step whose error is not known stays, and without a tolerance errors change nothing", "[serial]") {
  Clock adaptive = adaptive_clock(100, 1, 1e-3);
  adaptive.advance(adaptive.dt(), 0);
  CHECK(adaptive.dt() == 1);
  CHECK_FALSE(adaptive.is_too_coarse(0));
  adaptive.advance(adaptive.dt(), 5e-4);
  adaptive.advance(adaptive.dt(), 0);
  CHECK(adaptive.dt() == 1);
  Clock fixed = clock_of(100, 1);
  CHECK_FALSE(fixed.is_too_coarse(1e3));
  fixed.advance(fixed.dt(), 1e-9);
  CHECK(fixed.dt() == 1);
}

TEST_CASE("an adaptive step grows later while its error rises", "[serial]") {
  Clock rising = adaptive_clock(100, 1, 1e-3), steady = rising;
  rising.last_error = 3e-5;
  steady.last_error = 3e-4;
  rising.advance(1, 3e-4);
  steady.advance(1, 3e-4);
  CHECK(rising.dt() == 1);
  CHECK(steady.dt() == Approx(0.9 * std::cbrt(1 / 0.3)));
}

TEST_CASE("an adaptive step that did not converge is halved and does not grow in the next eight", "[serial]") {
  Clock clock = adaptive_clock(100, 1, 1e-3);
  clock.shrink();
  CHECK(clock.dt() == 0.5);
  for (int n = 0; n < 8; ++n) {
    clock.advance(clock.dt(), 1e-9);
    CHECK(clock.dt() == 0.5);
  }
  clock.advance(clock.dt(), 1e-9);
  CHECK(clock.dt() == 0.75);
  CHECK(clock.rejected == 1);
}
