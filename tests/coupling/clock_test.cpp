#include "coupling/clock.hpp"

#include <catch2/catch.hpp>

using vocalis::coupling::Clock;

namespace {

Clock clock_of(double end, double step) {
  Clock clock;
  clock.end = end;
  clock.nominal_step = step;
  clock.smallest_step = step / 64;
  return clock;
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
