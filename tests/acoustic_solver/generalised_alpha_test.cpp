#include "acoustic_solver/generalised_alpha.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

namespace vocalis::acoustic {
namespace {

/// Steps of ṗ = -ω ψ, ψ̇ = ω p, each solved for as `GeneralisedAlpha` says: implicit Euler from the shifted values.
void advance(const GeneralisedAlpha& scheme, double omega, double dt, bool keeps_rates, State& state) {
  Unknowns stage = scheme.shifted(state, dt);
  const double x = scheme.part() * dt * omega, p = stage.p[0], psi = stage.psi[0];
  stage.p[0] = (p - x * psi) / (1 + x * x);
  stage.psi[0] = (psi + x * p) / (1 + x * x);
  scheme.finish(stage, dt, keeps_rates, state);
}

State oscillation(double radius, double omega, double dt, int steps) {
  State state;
  state.p = {1};
  state.psi = {0};
  const GeneralisedAlpha scheme(radius);
  for (int n = 0; n < steps; ++n) {
    const bool is_first = n == 0 && radius < 1;
    advance(is_first ? GeneralisedAlpha::start() : scheme, omega, dt, radius < 1, state);
  }
  return state;
}

double size(const State& state) { return std::hypot(state.p[0], state.psi[0]); }

}  // namespace

TEST_CASE("generalised-α is of order 2 with any spectral radius", "[serial]") {
  for (const double radius : {1.0, 0.8, 0.5, 0.0}) {
    const auto error = [radius](int steps) {
      const State end = oscillation(radius, 1, 2.0 / steps, steps);
      return std::hypot(end.p[0] - std::cos(2.0), end.psi[0] - std::sin(2.0));
    };
    CHECK(std::log2(error(100) / error(200)) == Approx(2).margin(0.1));
  }
}

TEST_CASE("generalised-α multiplies what a step does not resolve by the spectral radius, and keeps what it does",
          "[serial]") {
  for (const double radius : {1.0, 0.8, 0.5}) {
    const double fast = size(oscillation(radius, 1e6, 1, 60)) / size(oscillation(radius, 1e6, 1, 59));
    CHECK(fast == Approx(radius).epsilon(0.03));  // the double eigenvalue is reached as 1 + 1 / steps
  }
  // 20 steps a period: what docs/theory.md says of bandwidths.
  const double omega = 2 * std::numbers::pi / 20;
  CHECK(size(oscillation(1, omega, 1, 2000)) == Approx(1).epsilon(1e-12));
  const double lost = 1 - size(oscillation(0.8, omega, 1, 2000)) / size(oscillation(0.8, omega, 1, 1980));
  CHECK(lost > 0);
  CHECK(lost < 2e-3);
}

TEST_CASE("a spectral radius of 1 is Crank-Nicolson and keeps no rates", "[serial]") {
  const State state = oscillation(1, 0.7, 1, 1);
  const double x = 0.35;
  CHECK(state.p[0] == Approx((1 - x * x) / (1 + x * x)).epsilon(1e-14));
  CHECK(state.psi[0] == Approx(2 * x / (1 + x * x)).epsilon(1e-14));
  CHECK(!state.has_rates);
  CHECK(state.rates.p.empty());
}

}  // namespace vocalis::acoustic
