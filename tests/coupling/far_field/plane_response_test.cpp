#include "coupling/far_field/plane_response.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace vocalis::coupling;

namespace {

constexpr double c = 340;

/// ∫ (τ + since - T) f(T) dT / sqrt(T² - τ²) from τ to τ + since, by the midpoint rule in x, T = τ cosh x, which has no
/// singularity.
template <class Function>
double integral(double since, double delay, const Function& f) {
  constexpr int points = 2000;
  const double end = std::acosh(1 + since / delay);
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    const double T = delay * std::cosh((i + 0.5) * end / points);
    sum += (delay + since - T) * f(T) * end / points;
  }
  return sum;
}

}  // namespace

TEST_CASE("responses in the plane are the second integrals of the Green's function behind its front", "[serial]") {
  for (const double delay : {1e-3, 0.05}) {
    for (const double since : {1e-7, 1e-4, 3e-3, 0.4}) {
      const double mass = integral(since, delay, [](double) { return 1 / (2 * std::numbers::pi); });
      const double force = integral(since, delay, [&](double T) { return T / (2 * std::numbers::pi * c * delay); });
      CHECK(line_mass_response(since, delay) == Approx(mass).epsilon(1e-6));
      CHECK(line_force_response(since, delay, c) == Approx(force).epsilon(1e-6));
    }
  }
}

TEST_CASE("there is nothing before the front", "[serial]") {
  CHECK(line_mass_response(0, 0.01) == 0);
  CHECK(line_mass_response(-1e-4, 0.01) == 0);
  CHECK(line_force_response(-1e-4, 0.01, c) == 0);
}

TEST_CASE("a steady force in the plane has the static field of a dipole", "[serial]") {
  // Of a rate that was 1 for a while and ended long ago: f is 1, and heard as 1 / (2π r).
  const double delay = 2e-3, late = 10, step = 1e-2;
  const auto response = [&](double since) { return line_force_response(since, delay, c); };
  const double heard = (response(late + step) - 2 * response(late) + response(late - step)) / (step * step);
  CHECK(heard == Approx(1 / (2 * std::numbers::pi * c * delay)).epsilon(1e-6));
}

TEST_CASE("responses are interpolated between few delays", "[serial]") {
  CHECK(response_delays(0.01, 0.01).size() == 1);
  for (const double largest : {0.0101, 0.015, 0.1}) {
    const auto nodes = response_delays(0.01, largest);
    CHECK(nodes.size() <= 22);  // ln 1e6 / ln 1.92, where the farthest is ten times as far as the nearest
    double worst = 0;
    for (const double since : {1e-5, 1e-3, 0.1}) {
      for (int i = 0; i <= 20; ++i) {
        const double delay = 0.01 + (largest - 0.01) * i / 20;
        const auto weights = interpolation_weights(nodes, delay);
        double force = 0, mass = 0;
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          force += weights[k] * line_force_response(since, nodes[k], c);
          mass += weights[k] * line_mass_response(since, nodes[k]);
        }
        worst = std::max(worst, std::abs(force / line_force_response(since, delay, c) - 1));
        worst = std::max(worst, std::abs(mass / line_mass_response(since, delay) - 1));
      }
    }
    CHECK(worst < 1e-5);
  }
}
