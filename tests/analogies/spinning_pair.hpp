#pragma once

#include <cmath>
#include <complex>

#include "tests/coupling/made_flow.hpp"

namespace vocalis::coupling::test {

/// How a vortex of radius r_c spreads its circulation.
enum class Core {
  scully,   ///< u_θ = Γ r / (2π (r_c² + r²)): a quarter of it is farther away than 1.7 r_c
  gaussian  ///< u_θ = Γ (1 - exp(-r² / r_c²)) / (2π r)
};

/// Two like vortices that go round each other (Powell 1964; Müller & Obermeier 1967).
struct SpinningPair {
  double circulation = 0;     ///< Γ [m^2/s] of each
  double orbit = 1;           ///< r0 [m]
  double core_radius = 0;     ///< r_c [m]
  double speed_of_sound = 0;  ///< c [m/s]
  double density = 0;         ///< ρ [kg/m^3]
  Core core = Core::scully;

  /// ω of point vortices [1/s]; sound has 2 ω.
  double angular_velocity() const { return circulation / (4 * M_PI * orbit * orbit); }
  double period() const { return M_PI / angular_velocity(); }  ///< of the sound [s]
  double wavelength() const { return speed_of_sound * period(); }
  double mach_number() const { return angular_velocity() * orbit / speed_of_sound; }
  double flow_radius() const {
    return 1.4 * wavelength();
  }  ///< of the disc in which the flow is taken into account [m]
};

/// The parameter sets of two programs' examples.
inline SpinningPair exadg() { return {7.54, 1, 0.1, 12, 2}; }
inline SpinningPair trixi() { return {4 * M_PI / 9, 1, 2.0 / 9, 1, 1}; }

/// A of the far field, ρ Γ⁴ / (64 π³ r0⁴ c²) [Pa].
inline double strength(const SpinningPair& pair) {
  return pair.density * std::pow(pair.circulation, 4) /
         (64 * std::pow(M_PI, 3) * std::pow(pair.orbit, 4) * std::pow(pair.speed_of_sound, 2));
}

/// C of the far field p = Re C exp(2iωt), p = A [J2(kr) sin ψ - Y2(kr) cos ψ], ψ = 2 (ωt - θ), k = 2ω / c.
inline std::complex<double> far_field(const SpinningPair& pair, double r, double theta) {
  const double kr = 2 * pair.angular_velocity() / pair.speed_of_sound * r;
  return strength(pair) * std::complex<double>(-std::cyl_neumann(2, kr), -std::cyl_bessel_j(2, kr)) *
         std::polar(1.0, -2 * theta);
}

/// What is left of the tensor's quadrupole ∫ u u as the cores are wide: over that of point vortices,
/// 2 ∫ J2(2k r0) f(k)² / k dk, where f is the transform of a core: k r_c K1(k r_c) of Scully's, and of Gaussian ones
/// exp(-k² r_c² / 4), with which it is 1 - (1 - exp(-z)) / z, z = 2 (r0 / r_c)².
inline double quadrupole_of_cores(const SpinningPair& pair) {
  const double s = pair.core_radius / pair.orbit, step = 0.01;
  if (pair.core == Core::gaussian) return 1 + std::expm1(-2 / (s * s)) * s * s / 2;
  double sum = 0;
  for (double x = step / 2; s * x < 40; x += step) {
    sum += std::cyl_bessel_j(2, 2 * x) * std::pow(s * x * std::cyl_bessel_k(1, s * x), 2) / x * step;
  }
  return 2 * sum;
}

namespace detail {

/// u of one vortex at the distance (x, y) from it.
inline Point swirl(const SpinningPair& pair, double x, double y) {
  const double square = x * x + y * y, core = pair.core_radius * pair.core_radius;
  const double q = square / core;
  const double over =
      pair.core == Core::scully ? 1 / (core + square) : (q > 1e-9 ? -std::expm1(-q) / square : 1 / core);
  const double factor = pair.circulation / (2 * M_PI) * over;
  return {-factor * y, factor * x, 0};
}

/// Its vorticity [1/s].
inline double spin(const SpinningPair& pair, double x, double y) {
  const double core = pair.core_radius * pair.core_radius, q = (x * x + y * y) / core;
  return pair.circulation / (M_PI * core) * (pair.core == Core::scully ? 1 / ((1 + q) * (1 + q)) : std::exp(-q));
}

/// Its pressure alone, -ρ ∫ u_θ² / r dr from there to infinity.
inline double suction(const SpinningPair& pair, double x, double y) {
  const double core = pair.core_radius * pair.core_radius, q = (x * x + y * y) / core;
  const double scale = -pair.density * std::pow(pair.circulation / (2 * M_PI), 2) / (2 * core);
  if (pair.core == Core::scully) return scale / (1 + q);
  if (q > 40) return scale / q;
  if (q < 1e-9) return scale * 2 * std::log(2);
  return scale * (std::pow(std::expm1(-q), 2) / q + 2 * (std::expint(-2 * q) - std::expint(-q)));
}

}  // namespace detail

/// Velocity: the sum of both. Pressure: Bernoulli's, with ∂t φ_j = -u_j·ẋ_j of each, and each one's own suction instead
/// of -ρ u_j² / 2; it solves Euler's equations outside of the cores and errs by O((r_c / r0)²) in them.
inline MadeFlow made_flow(const SpinningPair& pair) {
  struct Both {
    Point u[2], rate[2];
    double suction = 0;
  };
  const auto at = [pair](const Point& x, double t) {
    Both both;
    const double angle = pair.angular_velocity() * t, speed = pair.angular_velocity() * pair.orbit;
    for (int j = 0; j < 2; ++j) {
      const double side = j == 0 ? 1 : -1, c = side * std::cos(angle), s = side * std::sin(angle);
      const double dx = x[0] - pair.orbit * c, dy = x[1] - pair.orbit * s;
      both.u[j] = detail::swirl(pair, dx, dy);
      both.rate[j] = {-speed * s, speed * c, 0};
      both.suction += detail::suction(pair, dx, dy);
    }
    return both;
  };
  const auto dot = [](const Point& p, const Point& q) { return p[0] * q[0] + p[1] * q[1]; };
  MadeFlow flow;
  flow.velocity = [at](const Point& x, double t) {
    const Both both = at(x, t);
    return Point{both.u[0][0] + both.u[1][0], both.u[0][1] + both.u[1][1], 0};
  };
  flow.pressure = [at, dot, density = pair.density](const Point& x, double t) {
    const Both both = at(x, t);
    return density * (dot(both.u[0], both.rate[0]) + dot(both.u[1], both.rate[1]) - dot(both.u[0], both.u[1])) +
           both.suction;
  };
  return flow;
}

/// ω_z of both at time 0 [1/s].
inline double vorticity(const SpinningPair& pair, const Point& x) {
  return detail::spin(pair, x[0] - pair.orbit, x[1]) + detail::spin(pair, x[0] + pair.orbit, x[1]);
}

}  // namespace vocalis::coupling::test
