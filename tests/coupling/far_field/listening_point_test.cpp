#include "coupling/far_field/listening_point.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

using namespace vocalis::coupling;

namespace {

using Point = std::array<double, 3>;
using Complex = std::complex<double>;
using std::numbers::pi;

constexpr double c = 340, frequency = 500, omega = 2 * pi * frequency, period = 1 / frequency, k = omega / c;
const Point here = {0.6, 0.8, 0};  // r = 1 m; kr = 9.2

struct Signal {
  Point force;
  double mass_rate;
};

/// Sends A g(t) from a point at the origin in `samples` instants a period; what is heard at the end of each.
std::vector<double> heard(int dimension, const Signal& amplitude, const std::function<double(double)>& signal,
                          int samples, int periods, const Point& source = {0, 0, 0}) {
  const double interval = period / samples;
  const ListeningSettings settings = {
      .dimension = dimension, .speed_of_sound = c, .interval = interval, .end = periods * period};
  const double distance = std::hypot(here[0] - source[0], here[1] - source[1], here[2] - source[2]);
  ListeningPoint point(settings, here, std::vector<Point>{source}, {distance, distance});
  std::vector<double> result;
  for (int n = 1; n <= samples * periods; ++n) {
    const double g = signal(n * interval);
    Emission emission{.force = amplitude.force, .mass_rate = amplitude.mass_rate * g};
    for (double& component : emission.force) component *= g;
    point.send(n, std::vector<Emission>{emission});
    result.push_back(point.pressure(n * interval));
  }
  return result;
}

/// Without a jump at time 0, and harmonic after the first period.
double harmonic(double t) {
  const double part = std::min(t / (3 * period), 1.0);
  return 0.5 * (1 - std::cos(pi * part)) * std::cos(omega * t);
}

/// Amplitude P of Re(P e^{iωt}) over the last period.
Complex amplitude(const std::vector<double>& pressure, int samples) {
  Complex sum = 0;
  for (std::size_t n = pressure.size() - samples; n < pressure.size(); ++n) {
    const double t = static_cast<double>(n + 1) * period / samples;
    sum += pressure[n] * std::exp(Complex(0, -omega * t)) * 2.0 / static_cast<double>(samples);
  }
  return sum;
}

Complex hankel(int order, double x) { return {std::cyl_bessel_j(order, x), -std::cyl_neumann(order, x)}; }

/// The error of the amplitude, relative to the exact one.
double error(int dimension, const Signal& signal, const Complex& exact, int samples, int periods) {
  return std::abs(amplitude(heard(dimension, signal, harmonic, samples, periods), samples) - exact) / std::abs(exact);
}

/// At 40 instants a period central differences and straight lines between instants err by (ωΔ)² (1/6 + 1/8) at most,
/// 0.72 %, and the rate's straight lines in the plane by (ωΔ)² / 12 more, 0.93 %; with half the interval by a quarter.
void check_second_order(int dimension, const Signal& signal, const Complex& exact, int periods) {
  const double coarse = error(dimension, signal, exact, 40, periods);
  const double fine = error(dimension, signal, exact, 80, periods);
  const double bound = std::pow(2 * pi / 40, 2) * (1.0 / 6 + 1.0 / 8 + (dimension == 2 ? 1.0 / 12 : 0));
  CHECK(coarse < bound);
  CHECK(fine < bound / 4);
  CHECK(coarse / fine > 3.3);
}

const Signal along_x = {{2, 0, 0}, 0}, mass = {{0, 0, 0}, 3};

}  // namespace

TEST_CASE("a force in space is heard as p = cos θ / 4π (F' / cr + F / r²)", "[serial]") {
  const Complex exact = 2 * 0.6 / (4 * pi) * (Complex(0, k) + 1.0) * std::exp(Complex(0, -k));
  check_second_order(3, along_x, exact, 6);
}

TEST_CASE("a mass in space is heard as p = q' / 4πr", "[serial]") {
  check_second_order(3, mass, Complex(0, 3 * omega) / (4 * pi) * std::exp(Complex(0, -k)), 6);
}

TEST_CASE("a line force is heard as p = -(ikF/4) cos θ H1(kr)", "[serial]") {
  check_second_order(2, along_x, -Complex(0, k * 2 / 4) * 0.6 * hankel(1, k), 12);
}

TEST_CASE("a line of mass is heard as p = (ωq/4) H0(kr)", "[serial]") {
  check_second_order(2, mass, omega * 3 / 4 * hankel(0, k), 12);
}

TEST_CASE("nothing is heard before it can be", "[serial]") {
  for (const int dimension : {2, 3}) {
    const auto pressure = heard(
        dimension, {{2, 0, 0}, 3}, [](double) { return 1.0; }, 40, 3);
    const auto arrival = static_cast<std::size_t>(std::floor(1 / c / (period / 40)));
    for (std::size_t n = 0; n + 2 < arrival; ++n) CHECK(pressure[n] == 0);
    CHECK(std::abs(pressure[arrival + 2]) > 0);
  }
}

TEST_CASE("a steady force is heard as the static field", "[serial]") {
  const auto rising = [](double t) { return t < 3 * period ? 0.5 * (1 - std::cos(pi * t / (3 * period))) : 1.0; };
  CHECK(heard(3, along_x, rising, 20, 8).back() == Approx(2 * 0.6 / (4 * pi)).epsilon(1e-9));
  // What is left in the plane falls with the square of time: (τ / t)² / 2 or so.
  CHECK(heard(2, along_x, rising, 20, 60).back() == Approx(2 * 0.6 / (2 * pi)).epsilon(1e-3));
}

TEST_CASE("many sources are heard as the sum of each alone", "[serial]") {
  // In the plane the responses are interpolated between the delays of the nearest and the farthest.
  const std::vector<Point> sources = {{0, 0, 0}, {0.1, -0.2, 0}, {0.35, 0.5, 0}, {-0.2, 0.1, 0}};
  constexpr int samples = 40, periods = 6;
  constexpr double interval = period / samples;
  for (const int dimension : {2, 3}) {
    std::vector<double> alone(samples * periods, 0.0);
    std::array<double, 2> distances = {1e9, 0};
    for (const Point& source : sources) {
      const auto one = heard(dimension, {{2, 1, 0}, 0.01}, harmonic, samples, periods, source);
      for (std::size_t n = 0; n < one.size(); ++n) alone[n] += one[n];
      const double distance = std::hypot(here[0] - source[0], here[1] - source[1]);
      distances = {std::min(distances[0], distance), std::max(distances[1], distance)};
    }
    const ListeningSettings settings = {
        .dimension = dimension, .speed_of_sound = c, .interval = interval, .end = periods * period};
    ListeningPoint point(settings, here, sources, distances);
    double worst = 0, largest = 0;
    for (int n = 1; n <= samples * periods; ++n) {
      const double g = harmonic(n * interval);
      point.send(n, std::vector<Emission>(sources.size(), Emission{{2 * g, g, 0}, 0.01 * g}));
      worst = std::max(worst, std::abs(point.pressure(n * interval) - alone[n - 1]));
      largest = std::max(largest, std::abs(alone[n - 1]));
    }
    CHECK(worst < 1e-5 * largest);
  }
}

TEST_CASE("between instants the pressure is on a straight line", "[serial]") {
  const ListeningSettings settings = {.dimension = 3, .speed_of_sound = c, .interval = 1e-4, .end = 1};
  ListeningPoint point(settings, here, std::vector<Point>{{0, 0, 0}}, {1, 1});
  for (int n = 1; n <= 60; ++n) {
    point.send(n, std::vector<Emission>{{{0, 0, 0}, std::sin(0.3 * n)}});
  }
  CHECK(point.pressure(60.25e-4) == Approx(0.75 * point.pressure(60e-4) + 0.25 * point.pressure(61e-4)).epsilon(1e-9));
}
