#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>

#include "acoustic_solver/wall_branches.hpp"
#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using Complex = std::complex<double>;

/// The rate s of a mode cosh(s x / c) exp(s t) of a duct that ends with a wall, tanh(s L / c) = -ρ c Y(s), by Newton's
/// method.
Complex rate_of_duct(const AcousticSettings& settings, double length, std::span<const WallBranch> wall, Complex start) {
  const double c = settings.speed_of_sound;
  const auto residual = [&](Complex s) {
    return std::tanh(s * length / c) + settings.density * c * wall_admittance(wall, s);
  };
  Complex s = start;
  for (int i = 0; i < 50; ++i) {
    const Complex slope = (residual(s + 1e-6) - residual(s - 1e-6)) / 2e-6;
    s -= residual(s) / slope;
  }
  CHECK(std::abs(residual(s)) < 1e-8);
  return s;
}

/// Amplitude and phase of the mode cos(k x) of a strip after some periods, as a complex number that is 1 at first.
Complex ring(const mesh::Mesh& mesh, const AcousticSettings& settings, double k, double duration) {
  const double c = settings.speed_of_sound;
  const SpaceTime mode = [k](auto x, double) { return std::cos(k * x[0]); };
  AcousticSolver solver(mesh, settings);
  solver.set_state(state_of(
      mesh, mode, [](auto, double) { return 0.0; }, 0));
  const auto amplitude = [&] {
    Complex sum = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const double shape = std::cos(k * mesh.point(v)[0]);
      sum += shape * Complex(solver.state().p[v], settings.density * c * k * solver.state().psi[v]);
    }
    return Complex(base::sum(mesh.comm, sum.real()), base::sum(mesh.comm, sum.imag()));
  };
  const Complex before = amplitude();
  CHECK(solver.advance(duration).converged);
  return amplitude() / before;
}

}  // namespace

TEST_CASE("a duct closed by a yielding wall rings and dies at the rate of its complex mode") {
  for (const auto& [dimension, spectral_radius] : {std::pair{2, 1.0}, {2, 0.8}, {3, 1.0}}) {
    std::vector<double> errors;
    for (const int cells : {10, 20, 40}) {
      if (dimension == 3 && cells == 40) continue;
      const mesh::Mesh mesh = box_mesh({1, 0.2, dimension == 3 ? 0.2 : 0}, {cells, cells / 5, cells / 5});
      AcousticSettings settings;
      settings.speed_of_sound = 1;
      settings.density = 2;
      settings.step = 0.5 / cells;
      settings.spectral_radius = spectral_radius;
      AcousticBoundary wall{"right", AcousticBoundaryKind::yielding};
      wall.mass = 1;
      wall.resistance = 0.3;
      wall.stiffness = 4;
      settings.boundaries = {wall};
      const auto branches = wall_branches(settings, wall);
      const Complex s = rate_of_duct(settings, 1, branches, {-0.1, 3.5});
      const SpaceTime pressure = [s](auto x, double t) { return (std::cosh(s * x[0]) * std::exp(s * t)).real(); };
      const SpaceTime potential = [s](auto x, double t) {
        return (std::cosh(s * x[0]) * std::exp(s * t) / (2.0 * s)).real();
      };
      AcousticSolver solver(mesh, settings);
      State state = state_of(mesh, pressure, potential, 0);
      const Complex velocity = wall_admittance(branches, s) * std::cosh(s);
      state.wall_motion = solver.state().wall_motion;
      for (std::size_t i = 0; i < state.wall_motion.size(); i += 2) {
        state.wall_motion[i] = velocity.real();
        state.wall_motion[i + 1] = (velocity / s).real();
      }
      solver.set_state(std::move(state));
      CHECK(solver.advance(6).converged);
      errors.push_back(relative_error(solver, pressure));
    }
    print_errors(fmt::format("yielding end of a duct, {}-D, spectral radius {}", dimension, spectral_radius).c_str(),
                 errors);
    CHECK(errors.back() < (dimension == 2 ? 0.004 : 0.02));
    CHECK(lowest_order(errors) > 1.8);
  }
}

TEST_CASE("a plane wave along a wall is damped and delayed as Kirchhoff says") {
  // A strip of which one side has a boundary layer: S / A = 1 / height. A standing wave decays at c times the
  // attenuation of the travelling one, and its frequency falls by as much.
  const double length = 0.35, height = 0.004;
  const mesh::Mesh mesh = box_mesh({length, height, 0}, {160, 2, 0});
  AcousticSettings settings;
  settings.density = 1.14;
  settings.speed_of_sound = 350;
  settings.step = 5e-6;
  const AcousticBoundary wall{"bottom", AcousticBoundaryKind::viscothermal};
  for (const double frequency : {500.0, 2000.0, 4000.0}) {
    const double omega = 2 * std::numbers::pi * frequency, duration = 10e-3;
    settings.boundaries.clear();
    const Complex rigid = ring(mesh, settings, omega / settings.speed_of_sound, duration);
    settings.boundaries = {wall};
    const Complex change = std::log(ring(mesh, settings, omega / settings.speed_of_sound, duration) / rigid) / duration;
    const double kirchhoff =
        (std::sqrt(wall.kinematic_viscosity) + (wall.heat_capacity_ratio - 1) * std::sqrt(wall.thermal_diffusivity)) *
        std::sqrt(omega / 2) / (2 * height);
    if (base::rank(mesh.comm) == 0) {
      fmt::print("  {:6.0f} Hz: attenuation {:.4f} Np/m, delay {:.4f} rad/m, Kirchhoff {:.4f}\n", frequency,
                 -change.real() / settings.speed_of_sound, -change.imag() / settings.speed_of_sound,
                 kirchhoff / settings.speed_of_sound);
    }
    CHECK(std::abs(-change.real() / kirchhoff - 1) < 0.03);
    CHECK(std::abs(-change.imag() / kirchhoff - 1) < 0.03);
  }
}

}  // namespace vocalis::acoustic::verification
