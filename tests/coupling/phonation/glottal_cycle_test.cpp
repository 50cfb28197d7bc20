#include "coupling/phonation/glottal_cycle.hpp"

#include <catch2/catch.hpp>

#include "tests/coupling/phonation/waveforms.hpp"

using namespace vocalis::coupling;
using test::sample;

TEST_CASE("cycles of a pulse are where it opens, is largest and closes", "[serial]") {
  constexpr double step = 2e-5;
  const test::Triangle pulse;
  const auto [times, area] = sample(pulse, 0.048, step);
  const auto cycles = glottal_cycles(times, area, 0);
  REQUIRE(cycles.size() == 5);
  for (std::size_t n = 0; n < cycles.size(); ++n) {
    const double begin = pulse.period * static_cast<double>(n);
    CHECK(cycles[n].begin == Approx(begin + 0.5 * pulse.rise).margin(0.1 * step));
    CHECK(cycles[n].period() == Approx(pulse.period).margin(0.1 * step));
    CHECK(cycles[n].opens == Approx(begin).margin(step));
    CHECK(cycles[n].peak == Approx(begin + pulse.rise).margin(step));
    CHECK(cycles[n].closes == Approx(begin + pulse.rise + pulse.fall).margin(step));
    CHECK(cycles[n].largest_opening == Approx(pulse.height).epsilon(0.02));
    CHECK(cycles[n].closed);
  }
  CHECK(count_closures(area) == 6);
}

TEST_CASE("folds that do not close have cycles between the smallest openings", "[serial]") {
  const auto [times, area] = sample([](double t) { return 3 - 2 * std::cos(2 * M_PI * 125 * t); }, 0.045, 2e-5);
  const auto cycles = glottal_cycles(times, area, 0);
  REQUIRE(cycles.size() == 5);
  for (std::size_t n = 0; n < cycles.size(); ++n) {
    CHECK_FALSE(cycles[n].closed);
    CHECK(cycles[n].opens == Approx(0.008 * static_cast<double>(n)).margin(1e-5));
    CHECK(cycles[n].peak == Approx(0.008 * static_cast<double>(n) + 0.004).margin(1e-5));
    CHECK(cycles[n].closes == Approx(0.008 * static_cast<double>(n) + 0.008).margin(1e-5));
  }
  CHECK(count_closures(area) == 0);
}

TEST_CASE("folds that bounce when they close count once a cycle, from the first closure on", "[serial]") {
  const test::Triangle pulse;
  const auto bouncing = [&](double t) {
    const double after = std::fmod(t, pulse.period) - 5e-3;
    return pulse(t) + (after > 0 && after < 5e-4 ? 0.05 : 0);
  };
  const auto [times, area] = sample(bouncing, 0.048, 2e-5);
  const auto cycles = glottal_cycles(times, area, 0);
  REQUIRE(cycles.size() == 5);
  CHECK(cycles[2].opens == Approx(2 * pulse.period).margin(2e-5));
  CHECK(cycles[2].closes == Approx(2 * pulse.period + 4.5e-3).margin(2e-5));
  CHECK(count_closures(area) == 12);
}

TEST_CASE("what never swings has no cycles", "[serial]") {
  const auto [times, area] = sample([](double) { return 1; }, 0.05, 1e-4);
  CHECK(glottal_cycles(times, area, 0).empty());
  CHECK(glottal_cycles({}, {}, 0).empty());
  CHECK(count_closures({}) == 0);
}
