#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/microphones.hpp"
#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/ring_down.hpp"
#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using std::numbers::pi;
constexpr double kSpeed = 350, kDensity = 1.14;

AcousticSettings air(double step) {
  AcousticSettings settings;
  settings.speed_of_sound = kSpeed;
  settings.density = kDensity;
  settings.step = step;
  return settings;
}

// First cross mode of a plane duct, driven by the velocity G(t) cos(πy / H) at x = 0. Half of the pulse's spectrum lies
// below cut-on, c / 2H = 4375 Hz, and does not travel.
constexpr double kHeight = 0.04, kLength = 0.3, kWidth = 5e-5, kPeak = 2.5e-4;
double rate(double t) { return -(t - kPeak) / (kWidth * kWidth) * std::exp(-std::pow((t - kPeak) / kWidth, 2) / 2); }
double velocity(double t) { return std::exp(-std::pow((t - kPeak) / kWidth, 2) / 2); }

/// p / cos(πy / H) = ρ c ∫ J0(ω_c sqrt(τ² - x²/c²)) G'(t - τ) dτ over τ > x/c: what a Klein-Gordon equation with
/// ∂p/∂x = -ρ G' at x = 0 gives.
double cross_mode(double x, double t) {
  const double cut_on = pi * kSpeed / kHeight, travel = x / kSpeed;
  const int count = 200;
  // Only the times of the pulse count: |t - τ - peak| < 6 widths.
  const double from = std::max(travel, t - kPeak - 6 * kWidth), to = std::min(t, t - kPeak + 6 * kWidth);
  if (to <= from) return 0;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double tau = from + (i + 0.5) / count * (to - from);
    sum += std::cyl_bessel_j(0, cut_on * std::sqrt(std::max(0.0, tau * tau - travel * travel))) * rate(t - tau);
  }
  return kDensity * kSpeed * sum * (to - from) / count;
}

fem::Load driven_side(const fem::Space& space, double h, double time) {
  fem::Load load(space, 1);
  for (std::int32_t v = 0; v < space.mesh->vertices.num_owned; ++v) {
    const double* x = space.mesh->point(v);
    const bool at_end = x[1] < 1e-9 || x[1] > kHeight - 1e-9;
    if (x[0] < 1e-9) load.values[v] = velocity(time) * std::cos(pi * x[1] / kHeight) * h * (at_end ? 0.5 : 1);
  }
  return load;
}

double cross_mode_error(int cells) {
  const double h = kHeight / cells, dt = 0.4 * h / kSpeed, far = 0.1;
  const mesh::Mesh mesh = box_mesh({kLength, kHeight, 0}, {static_cast<int>(kLength / h + 0.5), cells, 0});
  AcousticSolver solver(mesh, air(dt));
  double difference = 0, scale = 0;
  for (int n = 0; (n + 1) * dt < (2 * kLength - far) / kSpeed; ++n) {
    const auto begin = driven_side(solver.space(), h, n * dt), end = driven_side(solver.space(), h, (n + 1) * dt);
    CHECK(solver.advance(dt, {}, {&begin, &end, {}}).converged);
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const double* x = mesh.point(v);
      if (x[1] > 1e-9 || x[0] > far + 1e-9 || std::abs(std::remainder(x[0], 0.02)) > 1e-9) continue;
      const double exact = cross_mode(x[0], solver.state().time);
      difference += std::pow(solver.state().p[v] - exact, 2);
      scale += exact * exact;
    }
  }
  return std::sqrt(base::sum(mesh.comm, difference) / base::sum(mesh.comm, scale));
}

/// A box of cells bent to a disc: its boundary vertices lie on the circle.
mesh::Mesh disc(double radius, int cells) {
  mesh::Mesh mesh = box_mesh({2, 2, 0}, {cells, cells, 0});
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double* x = mesh.coordinates.data() + static_cast<std::size_t>(v) * 2;
    const double u = x[0] - 1, w = x[1] - 1;
    x[0] = radius * u * std::sqrt(1 - w * w / 2);
    x[1] = radius * w * std::sqrt(1 - u * u / 2);
  }
  return mesh;
}

/// Relative errors of the first four cross modes of a circular duct on rank 0, 0 elsewhere. Where the mesh splits the
/// two modes that a circle has of each but the third, the larger one.
std::vector<double> circular_mode_errors(int cells) {
  const double radius = 0.01, dt = 4.8e-5 / cells;
  const mesh::Mesh mesh = disc(radius, cells);
  AcousticSolver solver(mesh, air(dt));
  Microphones microphones(mesh, {{"inside", {0.0061, 0.0043, 0}}});
  const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 30000});
  const auto load = [&](double t) {
    return load_of(
        solver.space(), mesh.coordinates,
        [&](auto x, double time) {
          const double away = std::hypot(x[0] + 0.006, x[1] - 0.003) / 0.002;
          return pulse.value(time) * std::exp(-away * away);
        },
        t);
  };
  for (int n = 0; n * dt < 2e-3; ++n) {
    const bool sounds = n * dt < pulse.end();
    const auto begin = sounds ? load(n * dt) : fem::Load(solver.space(), 1);
    const auto end = sounds ? load((n + 1) * dt) : fem::Load(solver.space(), 1);
    CHECK(solver.advance(dt, {}, {&begin, &end, {}}).converged);
    if (!sounds) microphones.sample(solver.state().time, solver.state().p);
  }
  const auto block = microphones.collect();
  std::vector<double> errors(4, 0.0);
  if (base::rank(mesh.comm) != 0) return errors;
  const auto modes = damped_modes(block.values, 1 / dt, {.minimum_frequency = 5000, .maximum_frequency = 30000});
  // Zeros of J1', J2', J0', J3'.
  constexpr std::array<double, 4> zeros = {1.84118, 3.05424, 3.83171, 4.20119};
  for (std::size_t i = 0; i < zeros.size(); ++i) {
    const double exact = zeros[i] * kSpeed / (2 * pi * radius);
    for (const DampedMode& mode : modes) {
      const double error = std::abs(mode.frequency() / exact - 1);
      if (error < 0.03) errors[i] = std::max(errors[i], error);
    }
    CHECK(errors[i] > 0);
  }
  return errors;
}

}  // namespace

TEST_CASE("a cross mode of a duct travels above its cut-on frequency and stays near its source below") {
  std::vector<double> errors;
  for (const int cells : {8, 16, 32}) errors.push_back(cross_mode_error(cells));
  print_errors("first cross mode of a plane duct, around cut-on", errors);
  CHECK(lowest_order(errors) > 1.7);
  CHECK(errors.back() < 0.02);
}

TEST_CASE("the cross modes of a circular duct cut on at the zeros of J'") {
  std::vector<std::vector<double>> by_mode(4);
  for (const int cells : {12, 24, 48}) {
    const auto errors = circular_mode_errors(cells);
    for (int i = 0; i < 4; ++i) by_mode[i].push_back(errors[i]);
  }
  for (int i = 0; i < 4; ++i) print_errors("cut-on of circular cross modes, 11 21 02 31", by_mode[i]);
  if (base::rank(MPI_COMM_WORLD) != 0) return;
  for (int i = 0; i < 4; ++i) CHECK(by_mode[i].back() < 0.001);
  // The pairs that the mesh splits beat with each other for longer than is listened.
  for (const int i : {0, 2}) CHECK(lowest_order(by_mode[i]) > 1.7);
}

}  // namespace vocalis::acoustic::verification
