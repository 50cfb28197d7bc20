#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using std::numbers::pi;

constexpr double kHeight = 0.2;

/// A duct 0 < x < length with square cells of length 1 / cells.
mesh::Mesh duct(double length, int cells) {
  return box_mesh({length, kHeight, 0}, {static_cast<int>(std::lround(length * cells)), cells / 5, 0});
}

std::vector<double> uniform(const mesh::Mesh& mesh, double speed) {
  std::vector<double> result(mesh.coordinates.size(), 0.0);
  for (std::size_t i = 0; i < result.size(); i += mesh.dimension) result[i] = speed;
  return result;
}

/// A pulse that goes downstream (direction 1) with c + U, or upstream (-1) with c - U: ψ = G(x - start ∓ (c ± U) t).
struct Pulse {
  double mach, direction, start, width = 0.15;
  double phase(double x, double t) const { return (x - start - (direction + mach) * t) / width; }
  double potential(double x, double t) const { return std::exp(-std::pow(phase(x, t), 2)); }
  double pressure(double x, double t) const { return direction * 2 * phase(x, t) / width * potential(x, t); }
};

/// Relative error of the pressure when the pulse has gone a length of 1.2.
double pulse_error(const Pulse& pulse, Integrator integrator, int cells, double step) {
  const SpaceTime pressure = [&](auto x, double t) { return pulse.pressure(x[0], t); };
  const SpaceTime potential = [&](auto x, double t) { return pulse.potential(x[0], t); };
  const mesh::Mesh mesh = duct(2.4, cells);
  AcousticSolver solver(mesh, unit_medium(step, integrator));
  solver.set_state(state_of(mesh, pressure, potential, 0));
  const std::vector<double> flow = uniform(mesh, pulse.mach);
  CHECK(solver.advance(1.2 / std::abs(pulse.direction + pulse.mach), {{}, {}, flow}).converged);
  return relative_error(solver, pressure);
}

/// Mode n of a duct 0 < x < 1 in a flow through both ends, where ψ = 0: ω = nπ (c² - U²) / (c L).
struct Resonance {
  double mach;
  int n = 2;
  double omega() const { return n * pi * (1 - mach * mach); }
  double down(double x, double t) const { return omega() * (t - x / (1 + mach)); }
  double up(double x, double t) const { return omega() * (t + x / (1 - mach)); }
  double potential(double x, double t) const { return std::cos(down(x, t)) - std::cos(up(x, t)); }
  double pressure(double x, double t) const {
    return omega() * (std::sin(up(x, t)) / (1 - mach) - std::sin(down(x, t)) / (1 + mach));
  }
};

double resonance_error(const Resonance& mode, Integrator integrator, int cells, double periods) {
  const SpaceTime pressure = [&](auto x, double t) { return mode.pressure(x[0], t); };
  const SpaceTime potential = [&](auto x, double t) { return mode.potential(x[0], t); };
  const mesh::Mesh mesh = duct(1, cells);
  AcousticSettings settings = unit_medium(0.25 / cells, integrator);
  settings.boundaries = {{"left", AcousticBoundaryKind::pressure_release},
                         {"right", AcousticBoundaryKind::pressure_release}};
  AcousticSolver solver(mesh, settings);
  solver.set_state(state_of(mesh, pressure, potential, 0));
  const std::vector<double> flow = uniform(mesh, mode.mach);
  CHECK(solver.advance(periods * 2 * pi / mode.omega(), {{}, {}, flow}).converged);
  return relative_error(solver, pressure);
}

/// What a pulse that has left through an open end leaves behind: the largest pressure, as a part of its own.
double rest_behind_open_end(const Pulse& pulse, Integrator integrator, int cells) {
  const SpaceTime pressure = [&](auto x, double t) { return pulse.pressure(x[0], t); };
  const SpaceTime potential = [&](auto x, double t) { return pulse.potential(x[0], t); };
  const mesh::Mesh mesh = duct(2.4, cells);
  AcousticSettings settings = unit_medium(0.25 / cells, integrator);
  settings.boundaries = {{"left", AcousticBoundaryKind::open}, {"right", AcousticBoundaryKind::open}};
  AcousticSolver solver(mesh, settings);
  solver.set_state(state_of(mesh, pressure, potential, 0));
  const auto largest = [&] {
    double result = 0;
    for (const double p : solver.state().p) result = std::max(result, std::abs(p));
    return base::largest(mesh.comm, result);
  };
  const double before = largest();
  const std::vector<double> flow = uniform(mesh, pulse.mach);
  CHECK(solver.advance(1.8 / std::abs(pulse.direction + pulse.mach), {{}, {}, flow}).converged);
  return largest() / before;
}

}  // namespace

TEST_CASE("plane waves in a flow go with c + U and c - U, with errors of order 2") {
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    for (const Pulse& pulse : {Pulse{0.3, 1, 0.6}, Pulse{0.3, -1, 1.8}, Pulse{0, 1, 0.6}}) {
      std::vector<double> errors;
      for (const int cells : {40, 80}) errors.push_back(pulse_error(pulse, integrator, cells, 0.25 / cells));
      const char* way = pulse.mach == 0 ? "at rest" : pulse.direction > 0 ? "downstream" : "upstream";
      print_errors(fmt::format("pulse {}, U = {} c, {}", way, pulse.mach, name(integrator)).c_str(), errors);
      CHECK(lowest_order(errors) > 1.8);
    }
  }
}

TEST_CASE("the implicit integrator's errors of time in a flow are of order 2") {
  // On one mesh, whose errors cancel in differences of successive steps.
  const Pulse pulse{0.3, 1, 0.6};
  const SpaceTime pressure = [&](auto x, double t) { return pulse.pressure(x[0], t); };
  const SpaceTime potential = [&](auto x, double t) { return pulse.potential(x[0], t); };
  const mesh::Mesh mesh = duct(2.4, 40);
  const std::vector<double> flow = uniform(mesh, pulse.mach);
  std::vector<double> last, differences;
  for (const int steps : {25, 50, 100, 200}) {
    AcousticSolver solver(mesh, unit_medium(0.9 / steps, Integrator::implicit));
    solver.set_state(state_of(mesh, pressure, potential, 0));
    CHECK(solver.advance(0.9, {{}, {}, flow}).converged);
    double square = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned && !last.empty(); ++v) {
      square += std::pow(solver.state().p[v] - last[v], 2);
    }
    if (!last.empty()) differences.push_back(std::sqrt(base::sum(mesh.comm, square)));
    last = solver.state().p;
  }
  print_errors("pulse downstream, differences of steps halved, implicit", differences);
  CHECK(std::log2(differences[1] / differences[2]) == Approx(2).margin(0.2));
}

TEST_CASE("a duct in a flow resonates at n (c² - U²) / (2 L c), with errors of order 2") {
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    for (const double mach : {0.0, 0.1, 0.3}) {
      std::vector<double> errors;
      for (const int cells : {20, 40}) errors.push_back(resonance_error({mach}, integrator, cells, 3));
      print_errors(fmt::format("resonance, U = {} c, {}", mach, name(integrator)).c_str(), errors);
      CHECK(lowest_order(errors) > 1.8);
    }
  }
}

TEST_CASE("an open end in a flow lets plane waves out as well as without a flow") {
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    for (const Pulse& pulse : {Pulse{0.3, 1, 1.5}, Pulse{0.3, -1, 0.9}, Pulse{0, 1, 1.5}}) {
      std::vector<double> rests;
      for (const int cells : {40, 80}) rests.push_back(rest_behind_open_end(pulse, integrator, cells));
      const char* way = pulse.mach == 0 ? "at rest" : pulse.direction > 0 ? "downstream" : "upstream";
      print_errors(fmt::format("open end {}, U = {} c, {}", way, pulse.mach, name(integrator)).c_str(), rests);
      CHECK(rests.back() < 0.01);
      CHECK(lowest_order(rests) > 1);
    }
  }
}

}  // namespace vocalis::acoustic::verification
