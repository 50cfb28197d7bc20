#include "coupling/phonation/cycle_figures.hpp"

#include <catch2/catch.hpp>

#include "tests/coupling/phonation/waveforms.hpp"

using namespace vocalis::coupling;
using test::sample;

namespace {

constexpr double step = 1e-5;

CycleFigures last_cycle(const PhonationSeries& series) {
  const auto cycles = glottal_cycles(series.times, series.opening, 0);
  REQUIRE(cycles.size() > 2);
  return measure_cycle(cycles.back(), series);
}

}  // namespace

TEST_CASE("quotients of a triangular pulse are those of its sides", "[serial]") {
  const test::Triangle pulse;
  const auto [times, area] = sample(pulse, 0.05, step);
  const CycleFigures figures = last_cycle({.times = times, .opening = area});
  CHECK(figures.frequency == Approx(125).epsilon(1e-4));
  CHECK(figures.open_quotient == Approx(4.5 / 8).margin(2 * step / pulse.period));
  CHECK(figures.wide_quotient == Approx(0.8 * 4.5 / 8).margin(2 * step / pulse.period));
  CHECK(figures.closing_quotient == Approx(1.5 / 8).margin(2 * step / pulse.period));
  CHECK(figures.speed_quotient == Approx(2).epsilon(0.02));
  CHECK_FALSE(figures.peak_flow);
  CHECK_FALSE(figures.leak);
}

TEST_CASE("quotients of half a sine are its length and one", "[serial]") {
  const auto [times, area] = sample(
      [](double t) {
        const double phase = std::fmod(t, 0.01) / 0.006;
        return phase < 1 ? std::sin(M_PI * phase) : 0.0;
      },
      0.05, step);
  const CycleFigures figures = last_cycle({.times = times, .opening = area});
  CHECK(figures.open_quotient == Approx(0.6).margin(2e-3));
  CHECK(figures.closing_quotient == Approx(0.3).margin(2e-3));
  CHECK(figures.speed_quotient == Approx(1).epsilon(0.01));
}

TEST_CASE("folds that do not close are open all the time", "[serial]") {
  const auto [times, area] = sample([](double t) { return 3 - 2 * std::cos(2 * M_PI * 125 * t); }, 0.045, step);
  const CycleFigures figures = last_cycle({.times = times, .opening = area, .glottal_flow = area});
  CHECK(figures.open_quotient == 1);
  CHECK(figures.wide_quotient == Approx(std::acos(-0.6) / M_PI).epsilon(1e-3));
  CHECK(figures.closing_quotient == Approx(0.5).epsilon(1e-3));
  CHECK_FALSE(figures.leak);
}

TEST_CASE("peak, mean and declination of a flow, and the speed of the jet", "[serial]") {
  const test::Triangle pulse{.height = 3e-4};
  const auto [times, flow] = sample(pulse, 0.05, step);
  std::vector<double> area;
  for (const double value : flow) area.push_back(value / 20);
  const CycleFigures figures = last_cycle({.times = times, .opening = area, .flow = flow});
  CHECK(*figures.peak_flow == Approx(3e-4).epsilon(0.01));
  CHECK(*figures.mean_flow == Approx(3e-4 * 4.5 / 16).epsilon(0.002));
  CHECK(*figures.declination == Approx(3e-4 / 1.5e-3).epsilon(1e-6));
  CHECK(*figures.jet_speed == Approx(20).epsilon(0.02));
}

TEST_CASE("a flow that is shut off falls by all of it in a fifth of a millisecond", "[serial]") {
  const auto [times, flow] = sample([](double t) { return t < 0.02 ? 3.0 : 0.0; }, 0.04, step);
  CHECK(flow_declination(times, flow, 0.01, 0.03) == Approx(3 / 2e-4));
  CHECK(flow_declination(times, flow, 0.03, 0.04) == 0);
}

TEST_CASE("the leak is what passes the folds while the glottis is closed, not what they push out", "[serial]") {
  const test::Triangle pulse;
  const auto [times, area] = sample(pulse, 0.05, step);
  std::vector<double> glottal_flow = area, mouth_flow = area;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (area[i] == 0) glottal_flow[i] = -0.006;
    if (area[i] == 0) mouth_flow[i] = 0.3;
  }
  const CycleFigures figures =
      last_cycle({.times = times, .opening = area, .flow = mouth_flow, .glottal_flow = glottal_flow});
  CHECK(*figures.leak == Approx(0.006 / 2).epsilon(0.01));
}

TEST_CASE("speeds and stresses are the largest of the cycle, amplitudes half of the way", "[serial]") {
  const test::Triangle pulse;
  const auto [times, area] = sample(pulse, 0.05, step);
  const auto speed = sample([&](double t) { return 30 + pulse(t); }, 0.05, step).values;
  const auto stress = sample([&](double t) { return pulse(t) == 0 ? 500.0 : 0.0; }, 0.05, step).values;
  const auto tip = sample([&](double t) { return 1 + 4e-4 * std::sin(2 * M_PI * 125 * t); }, 0.05, step).values;
  const CycleFigures figures = last_cycle(
      {.times = times, .opening = area, .speed = speed, .impact_stress = stress, .displacements = {tip, speed}});
  CHECK(*figures.peak_speed == Approx(32).epsilon(1e-3));
  CHECK(*figures.impact_stress == 500);
  REQUIRE(figures.amplitudes.size() == 2);
  CHECK(figures.amplitudes[0] == Approx(4e-4).epsilon(1e-4));
  CHECK(figures.amplitudes[1] == Approx(1).epsilon(0.01));
}

TEST_CASE("the spread of figures is how far they lie apart, of their mean", "[serial]") {
  CHECK(spread(std::vector<double>{99, 100, 101}) == Approx(0.02));
  CHECK(spread(std::vector<double>{7}) == 0);
}
