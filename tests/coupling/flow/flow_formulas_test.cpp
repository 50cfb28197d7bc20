#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <numbers>

#include "coupling/flow/given_flow_settings.hpp"

using namespace vocalis::coupling;
using Vector = std::array<double, 3>;

namespace {

constexpr double step = 1e-4;  // of finite differences; fourth order

/// d f / d s at s = 0, f a number.
double slope(const std::function<double(double)>& f) {
  return (8 * (f(step) - f(-step)) - (f(2 * step) - f(-2 * step))) / (12 * step);
}

Vector moved(Vector x, int axis, double s) {
  x[axis] += s;
  return x;
}

template <class Flow>
double divergence(const Flow& flow, const Vector& x, double t) {
  return slope([&](double s) { return velocity(flow, moved(x, 0, s), t)[0]; }) +
         slope([&](double s) { return velocity(flow, moved(x, 1, s), t)[1]; });
}

/// ρ (∂t u + u·∇u) + ∇p, x and y.
template <class Flow>
std::array<double, 2> missing_force(const Flow& flow, double density, const Vector& x, double t) {
  std::array<double, 2> result = {};
  const Vector u = velocity(flow, x, t);
  for (int i = 0; i < 2; ++i) {
    result[i] = density * slope([&](double s) { return velocity(flow, x, t + s)[i]; });
    for (int k = 0; k < 2; ++k) {
      result[i] += density * u[k] * slope([&](double s) { return velocity(flow, moved(x, k, s), t)[i]; });
    }
    result[i] += slope([&](double s) { return pressure(flow, moved(x, i, s), t); });
  }
  return result;
}

const VortexPair pair = {.density = 2,
                         .circulation = 7.54,
                         .radius = 1,
                         .core_radius = 0.1,
                         .centre = {0.3, -0.2, 0},
                         .phase = 0.4,
                         .rotation_rate = 0.6};
const Vector points[] = {{0.3, -0.2, 0}, {0.95, 0.55, 0}, {1.1, 0.1, 0}, {1.2, 0.9, 0}, {-2, 1, 0}, {5, -7, 0}};

/// u and ω of one vortex of the pair at a point, and the velocity of its middle, from their definitions.
struct Vortex {
  Vector field, motion;
  double vorticity;
};
Vortex vortex(double side, const Vector& x, double t) {
  const double angle = pair.phase + pair.rotation_rate * t, a = pair.core_radius, r0 = pair.radius;
  const Vector middle = {pair.centre[0] + side * r0 * std::cos(angle), pair.centre[1] + side * r0 * std::sin(angle)};
  const double dx = x[0] - middle[0], dy = x[1] - middle[1], square = dx * dx + dy * dy + a * a;
  const double strength = pair.circulation / (2 * std::numbers::pi);
  return {{-strength * dy / square, strength * dx / square},
          {-side * pair.rotation_rate * r0 * std::sin(angle), side * pair.rotation_rate * r0 * std::cos(angle)},
          2 * strength * a * a / (square * square)};
}

}  // namespace

TEST_CASE("a vortex pair has no divergence", "[serial]") {
  for (const Vector& x : points) CHECK(std::abs(divergence(pair, x, 0.7)) < 1e-8);
}

TEST_CASE("a vortex pair's momentum lacks the strain of its cores and no more", "[serial]") {
  for (const Vector& x : points) {
    const Vortex one = vortex(1, x, 0.7), other = vortex(-1, x, 0.7);
    // (V₁ - u₂) × ω₁ + (V₂ - u₁) × ω₂; a × ω e_z = ω (a_y, -a_x)
    const auto force = missing_force(pair, pair.density, x, 0.7);
    const double wanted[] = {pair.density * ((one.motion[1] - other.field[1]) * one.vorticity +
                                             (other.motion[1] - one.field[1]) * other.vorticity),
                             -pair.density * ((one.motion[0] - other.field[0]) * one.vorticity +
                                              (other.motion[0] - one.field[0]) * other.vorticity)};
    for (int i = 0; i < 2; ++i) CHECK(force[i] == Approx(wanted[i]).margin(1e-6));
  }
}

TEST_CASE("outside of its cores a vortex pair obeys the momentum equation", "[serial]") {
  VortexPair thin = pair;
  thin.core_radius = 1e-3;
  for (const Vector& x : points) {
    if (x[0] == 0.95) continue;
    for (const double force : missing_force(thin, thin.density, x, 0.7)) CHECK(std::abs(force) < 1e-4);
  }
}

TEST_CASE("the vortices of a pair turn at half of their frequency of sound", "[serial]") {
  CHECK(rotation_rate_of_points(7.54, 1) == Approx(0.60001).epsilon(1e-4));
  const double turn = 2 * std::numbers::pi / pair.rotation_rate;
  const Vector x = {2, 3, 0};
  CHECK(pressure(pair, x, 0.2 + turn / 2) == Approx(pressure(pair, x, 0.2)));
  CHECK(std::abs(pressure(pair, x, 0.2 + turn / 4) - pressure(pair, x, 0.2)) > 1e-3);
}

TEST_CASE("a piston in a duct obeys the momentum equation, and its end is open", "[serial]") {
  const DuctPiston duct = {
      .density = 1.2, .pulse = {.amplitude = 0.3, .maximum_frequency = 2}, .start = -1, .length = 4};
  const double delay = vocalis::acoustic::GaussianFlux(duct.pulse).delay();
  CHECK(velocity(duct, {1, 0, 0}, delay)[0] == Approx(0.3));
  for (const double x : {-1.0, 0.5, 2.9}) {
    for (const double force : missing_force(duct, 1.2, {x, 0, 0}, 0.9 * delay)) CHECK(std::abs(force) < 1e-7);
  }
  CHECK(pressure(duct, {3, 0, 0}, 0.9 * delay) == Approx(0).margin(1e-12));
  CHECK(pressure(duct, {-1, 0, 0}, 0.9 * delay) > 0);
}
