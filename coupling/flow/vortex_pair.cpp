#include "coupling/flow/vortex_pair.hpp"

#include <cmath>
#include <numbers>

namespace vocalis::coupling {

namespace {

using Vector = std::array<double, 3>;
using std::numbers::pi;

/// One of the two at a time, as seen from a point.
struct Vortex {
  Vector field;         ///< u_i at the point
  Vector motion;        ///< V_i of its middle
  double own_pressure;  ///< over ρ
};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }

/// side  1: the first; -1: the one opposite
Vortex vortex_of(const VortexPair& pair, double side, const Vector& point, double time) {
  const double angle = pair.phase + pair.rotation_rate * time;
  const double x = side * pair.radius * std::cos(angle), y = side * pair.radius * std::sin(angle);
  const double dx = point[0] - pair.centre[0] - x, dy = point[1] - pair.centre[1] - y;
  const double square = pair.core_radius * pair.core_radius + dx * dx + dy * dy;
  const double strength = pair.circulation / (2 * pi);
  return {.field = {-strength * dy / square, strength * dx / square, 0},
          .motion = {-pair.rotation_rate * y, pair.rotation_rate * x, 0},
          .own_pressure = -strength * strength / (2 * square)};
}

}  // namespace

double rotation_rate_of_points(double circulation, double radius) { return circulation / (4 * pi * radius * radius); }

Vector velocity(const VortexPair& pair, const Vector& point, double time) {
  const Vortex one = vortex_of(pair, 1, point, time), other = vortex_of(pair, -1, point, time);
  return {one.field[0] + other.field[0], one.field[1] + other.field[1], 0};
}

double pressure(const VortexPair& pair, const Vector& point, double time) {
  const Vortex one = vortex_of(pair, 1, point, time), other = vortex_of(pair, -1, point, time);
  return pair.density * (dot(one.motion, one.field) + one.own_pressure + dot(other.motion, other.field) +
                         other.own_pressure - dot(one.field, other.field));
}

}  // namespace vocalis::coupling
