#include "coupling/statistics.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

using Values = std::vector<double>;

/// Times from 0 to `end` whose steps differ by up to a factor of two.
Values uneven_times(double end, double step) {
  Values times;
  for (double t = 0; t < end; t += step * (1 + 0.33 * std::sin(37 * t / step))) times.push_back(t);
  return times;
}

Values sampled(const Values& times, const std::function<double(double)>& signal) {
  Values values;
  for (const double t : times) values.push_back(signal(t));
  return values;
}

double wave(double frequency, double time) { return std::sin(2 * std::numbers::pi * frequency * time); }

StatisticsSettings periodic(const std::string& column, double begin = 0) {
  return {StatisticsKind::periodic, column, begin};
}

}  // namespace

TEST_CASE("the extremum of a parabola is found between its samples", "[serial]") {
  const Values times = {0, 0.3, 0.7, 1.2, 1.5};
  const Values values = sampled(times, [](double t) { return 3 - 2 * (t - 0.81) * (t - 0.81); });
  const auto high = extremum(times, values, 0, 2, 1);
  REQUIRE(high);
  CHECK(high->time == Approx(0.81).epsilon(1e-12));
  CHECK(high->value == Approx(3).epsilon(1e-12));
  const auto low = extremum(times, values, 0.2, 1.3, -1);
  REQUIRE(low);  // at the interval's beginning, where the series goes on falling: the sample itself
  CHECK(low->time == 0.3);
  CHECK(low->value == values[1]);
  const auto edge = extremum(times, values, 0.9, 2, 1);
  REQUIRE(edge);
  CHECK(edge->value == values[3]);
  CHECK_FALSE(extremum(times, values, 0.31, 0.69, 1));
}

TEST_CASE("extrema between samples are third order in the step", "[serial]") {
  double error[2];
  for (int i = 0; i < 2; ++i) {
    const Values times = uneven_times(1, i == 0 ? 0.02 : 0.01);
    const auto peak = extremum(times, sampled(times, [](double t) { return wave(1, t) + 0.3 * wave(2, t); }), 0, 1, 1);
    // The peak of sin(x) + 0.3 sin(2x), where cos(x) + 0.6 cos(2x) = 0
    const double cosine = (-1 + std::sqrt(1 + 8 * 0.36)) / 2.4, x = std::acos(cosine);
    error[i] = std::abs(peak->value - (std::sin(x) + 0.3 * std::sin(2 * x)));
    CHECK(peak->time == Approx(x / (2 * std::numbers::pi)).epsilon(1e-2));
  }
  CHECK(error[0] < 1e-4);
  CHECK(error[1] < error[0] / 4);
}

TEST_CASE("mean, amplitude and frequency of a known swing are found at uneven times", "[serial]") {
  const Values times = uneven_times(3, 0.004);
  const std::vector<MonitorColumn> columns = {
      {"tip_y", "_m"}, {"drag", "_N"}, {"lift_coefficient", ""}, {"twist", "_m"}};
  const std::vector<Values> values = {sampled(times, [](double t) { return 1.5 + 35 * wave(5.46, t); }),
                                      sampled(times, [](double t) { return 460 + 27 * wave(10.92, t + 0.01); }),
                                      sampled(times, [](double t) { return 2 + 1e-15 * wave(3, t); }),
                                      sampled(times, [](double t) { return wave(10.92, t) + 0.3 * wave(5.46, t); })};
  const auto found = statistics(periodic("tip_y_m"), times, columns, values);
  CHECK(found.at("tip_y_mean_m") == Approx(1.5).epsilon(1e-3));
  CHECK(found.at("tip_y_amplitude_m") == Approx(35).epsilon(1e-4));
  CHECK(found.at("tip_y_max_m") == Approx(36.5).epsilon(1e-4));
  CHECK(found.at("tip_y_min_m") == Approx(-33.5).epsilon(1e-4));
  CHECK(found.at("tip_y_frequency_Hz") == Approx(5.46).epsilon(1e-4));
  CHECK(std::abs(found.at("tip_y_drift")) < 1e-4);
  CHECK(found.at("drag_mean_N") == Approx(460).epsilon(1e-4));
  CHECK(found.at("drag_amplitude_N") == Approx(27).epsilon(1e-3));
  CHECK(found.at("drag_frequency_Hz") == Approx(10.92).epsilon(1e-4));
  CHECK(found.at("lift_coefficient_mean") == Approx(2));
  CHECK(found.at("lift_coefficient_amplitude") < 1e-14);
  CHECK(found.count("lift_coefficient_frequency_Hz") == 0);
  // Its periods are by turns longer and shorter; two of them fit into one of the tip.
  CHECK(found.at("twist_frequency_Hz") == Approx(10.92).epsilon(1e-4));
}

TEST_CASE("noise below the hysteresis makes no periods", "[serial]") {
  const Values times = uneven_times(2, 0.0005);
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> noise(-0.02, 0.02);
  const Values values = sampled(times, [&](double t) { return 3 + wave(4, t) + noise(generator); });
  const Values crossings = up_crossings(times, values, 0);
  REQUIRE(crossings.size() >= 7);
  for (std::size_t i = 1; i < crossings.size(); ++i) {
    CHECK(crossings[i] - crossings[i - 1] == Approx(0.25).margin(0.004));
  }
}

TEST_CASE("a start-up far away from the swing does not hide it, and the swing's own mean counts", "[serial]") {
  const Values times = uneven_times(20, 0.01);
  const Values values = sampled(times, [](double t) { return 500 * std::exp(-3 * t) + 7 + 2 * wave(1.25, t); });
  const auto found = statistics(periodic("drag_N"), times, {{"drag", "_N"}}, {values});
  CHECK(found.at("drag_mean_N") == Approx(7).epsilon(1e-3));
  CHECK(found.at("drag_frequency_Hz") == Approx(1.25).epsilon(1e-3));
}

TEST_CASE("crossings are those of the last period's middle", "[serial]") {
  const Values times = uneven_times(20, 0.01);
  const Values values = sampled(times, [](double t) { return 3 * std::exp(-0.5 * t) + 7 + 2 * wave(1.25, t); });
  CHECK(up_crossings(times, values, 0).back() == Approx(19.2).margin(2e-3));
}

TEST_CASE("a swing that still grows tells by how much", "[serial]") {
  const Values times = uneven_times(10, 0.005);
  const Values values = sampled(times, [](double t) { return std::exp(0.05 * t) * wave(1, t); });
  const auto found = statistics(periodic("tip_m"), times, {{"tip", "_m"}}, {values});
  CHECK(found.at("tip_drift") == Approx(1 - std::exp(-0.05)).epsilon(0.02));
}

TEST_CASE("the pressure half a period after the leading column's maximum is told", "[serial]") {
  const Values times = uneven_times(4, 0.002);
  const auto found = statistics(periodic("lift_coefficient"), times, {{"lift_coefficient", ""}, {"fall", "_Pa"}},
                                {sampled(times, [](double t) { return wave(2, t + 0.03); }),
                                 sampled(times, [](double t) { return 2.5 + 0.2 * wave(2, t + 0.07); })});
  // The maximum is at 0.125 - 0.03; half a period later the pressure's phase is 0.375 + 0.04.
  CHECK(found.at("fall_half_period_Pa") == Approx(2.5 + 0.2 * wave(2, 0.375 + 0.04)).epsilon(1e-4));
  CHECK(found.count("lift_coefficient_half_period") == 0);
}

TEST_CASE("extrema come with their times, and only from the beginning on", "[serial]") {
  const Values times = uneven_times(8, 0.01);
  const Values values = sampled(times, [](double t) { return wave(1.0 / 16, t) - 0.5 * std::exp(-10 * t); });
  const StatisticsSettings settings = {StatisticsKind::extrema, "", 3};
  const auto found = statistics(settings, times, {{"drag_coefficient", ""}}, {values});
  CHECK(found.at("drag_coefficient_max") == Approx(1).epsilon(1e-6));
  CHECK(found.at("drag_coefficient_max_time_s") == Approx(4).epsilon(1e-4));
  CHECK(found.at("drag_coefficient_min_time_s") > 3);
  CHECK(found.at("drag_coefficient") == values.back());
}

TEST_CASE("the last values keep the names of their columns", "[serial]") {
  const auto found = statistics({}, Values{1, 2}, {{"drag", "_N"}, {"tip_x", "_m"}}, {{3, 4}, {5, 6}});
  CHECK(found == std::map<std::string, double>{{"drag_N", 4}, {"tip_x_m", 6}});
}

TEST_CASE("what has no period yet has no results, and no samples make no mistake", "[serial]") {
  for (const std::size_t rows : {0, 1, 2, 3}) {
    Values times, values;
    for (std::size_t i = 0; i < rows; ++i) times.push_back(i), values.push_back(i);
    CHECK(statistics(periodic("tip_m"), times, {{"tip", "_m"}}, {values}).empty());
    CHECK_NOTHROW(statistics({StatisticsKind::extrema, "", 0}, times, {{"tip", "_m"}}, {values}));
  }
}

TEST_CASE("the column that makes the period must be one of the case's", "[serial]") {
  CHECK_NOTHROW(check_statistics(periodic("tip_y_m"), {"drag_N", "tip_y_m"}));
  CHECK_NOTHROW(check_statistics({}, {}));
  CHECK_THROWS_WITH(check_statistics(periodic("tip_y"), {"drag_N", "tip_y_m"}),
                    Catch::Contains("did you mean \"tip_y_m\""));
}
