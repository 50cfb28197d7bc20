#include "coupling/flow/time_derivative.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace vocalis::coupling;

namespace {

using Function = double (*)(double);

std::deque<FlowSnapshot> samples(const std::vector<double>& times, const std::function<double(double)>& pressure) {
  std::deque<FlowSnapshot> result;
  for (const double time : times) {
    result.emplace_back();
    result.back().time = time;
    result.back().pressure = {pressure(time)};
  }
  return result;
}

double rate(const std::vector<double>& times, const std::function<double(double)>& pressure, int at,
            PressureDerivative derivative) {
  return pressure_rate(samples(times, pressure), at, derivative)[0];
}

/// Five times around 1; steps that jump by half, or that grow evenly.
std::vector<double> jumping(double dt) { return {1 - 2.5 * dt, 1 - dt, 1, 1 + 1.5 * dt, 1 + 2.5 * dt}; }
std::vector<double> growing(double dt) {
  std::vector<double> times;
  for (int n = -2; n <= 2; ++n) times.push_back(1 + n * dt * (1 + n * dt));
  return times;
}
std::vector<double> even(double dt) { return {1 - 2 * dt, 1 - dt, 1, 1 + dt, 1 + 2 * dt}; }

}  // namespace

TEST_CASE("bdf2 is exact for parabolas and of second order at any steps", "[serial]") {
  const auto parabola = [](double t) { return 3 - 2 * t + 5 * t * t; };
  CHECK(rate(jumping(0.1), parabola, 2, PressureDerivative::bdf2) == Approx(8).epsilon(1e-12));
  const auto wave = [](double t) { return std::sin(3 * t); };
  const auto error = [&](double dt) {
    return std::abs(rate(jumping(dt), wave, 2, PressureDerivative::bdf2) - 3 * std::cos(3.0));
  };
  CHECK(std::log2(error(0.02) / error(0.01)) == Approx(2).margin(0.1));
}

TEST_CASE("five_point is exact for lines at any steps, and of second order where these change gently", "[serial]") {
  const auto line = [](double t) { return 3 - 2 * t; };
  CHECK(rate(jumping(0.1), line, 2, PressureDerivative::five_point) == Approx(-2).epsilon(1e-12));
  const auto wave = [](double t) { return std::sin(3 * t); };
  for (const auto times : {even, growing}) {
    const auto error = [&](double dt) {
      return std::abs(rate(times(dt), wave, 2, PressureDerivative::five_point) - 3 * std::cos(3.0));
    };
    CHECK(std::log2(error(0.02) / error(0.01)) == Approx(2).margin(0.1));
  }
}

TEST_CASE("five_point does not see what alternates from step to step, bdf2 does", "[serial]") {
  for (const auto times : {even, growing, jumping}) {
    std::deque<FlowSnapshot> sawtooth = samples(times(0.1), [](double) { return 0.0; });
    for (std::size_t n = 0; n < sawtooth.size(); ++n) sawtooth[n].pressure[0] = n % 2 == 0 ? 1 : -1;
    CHECK(pressure_rate(sawtooth, 2, PressureDerivative::five_point)[0] == 0);
    CHECK(std::abs(pressure_rate(sawtooth, 2, PressureDerivative::bdf2)[0]) > 10);
  }
}

TEST_CASE("gain and phase of the derivatives at ten samples a period are those of the table", "[serial]") {
  const double omega = 2 * M_PI / 10;
  const auto gain = [&](PressureDerivative derivative) {
    const std::vector<double> times = {0, 1, 2, 3, 4};
    const double c = rate(
        times, [&](double t) { return std::cos(omega * (t - 2)); }, 2, derivative);
    const double s = rate(
        times, [&](double t) { return std::sin(omega * (t - 2)); }, 2, derivative);
    return std::array<double, 2>{std::hypot(c, s) / omega, std::atan2(c, s) * 180 / M_PI};
  };
  const auto bdf2 = gain(PressureDerivative::bdf2), five_point = gain(PressureDerivative::five_point);
  CHECK(bdf2[0] == Approx(1.116).margin(1e-3));
  CHECK(std::abs(bdf2[1]) == Approx(3.0).margin(0.05));
  CHECK(five_point[0] == Approx(0.846).margin(1e-3));
  CHECK(five_point[1] == Approx(0).margin(1e-9));
}

TEST_CASE("five_point lags by two steps, the others by none", "[serial]") {
  CHECK(lag_of(PressureDerivative::step) == 0);
  CHECK(lag_of(PressureDerivative::bdf2) == 0);
  CHECK(lag_of(PressureDerivative::five_point) == 2);
}
