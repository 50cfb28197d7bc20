#include <catch2/catch.hpp>
#include <cmath>

#include "acoustic_solver/microphones.hpp"
#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/ring_down.hpp"
#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

/// A sector of a spherical shell (a ring in 2-D) between two radii: a box whose x is the radius, and whose sides lie on
/// rays through the centre. "left" is the inner, "right" the outer sphere.
mesh::Mesh sector(int dimension, double inner, double outer, int cells) {
  const double half_angle = 0.25;
  mesh::Mesh mesh = box_mesh({outer - inner, 2 * half_angle, dimension == 3 ? 2 * half_angle : 0}, {cells, 6, 6});
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double* x = mesh.coordinates.data() + static_cast<std::size_t>(v) * dimension;
    const double radius = inner + x[0];
    double direction[3] = {1, x[1] - half_angle, dimension == 3 ? x[2] - half_angle : 0};
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (int k = 0; k < dimension; ++k) x[k] = radius * direction[k] / length;
  }
  return mesh;
}

}  // namespace

TEST_CASE("V1: a tube closed at one end and released at the other rings at (2n - 1) c / 4L") {
  const double length = 0.17;
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = box_mesh({length, 0.01, dimension == 3 ? 0.01 : 0}, {51, 3, 3});
    AcousticSettings settings;
    settings.density = 1.14;
    settings.speed_of_sound = 350;
    settings.step = 5e-6;
    settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::pressure_release}};
    AcousticSolver solver(mesh, settings);
    Microphones microphones(mesh, {{"inside", {0.021, 0.005, dimension == 3 ? 0.005 : 0}}});
    microphones.require_inside();
    const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 6000});
    const Source source = {nullptr, nullptr, [&](double t) { return t < pulse.end() ? pulse.value(t) : 0; }};
    const auto listen = [&](double t) {
      if (t >= pulse.end()) microphones.sample(t, solver.state().p);
    };
    CHECK(solver.advance(0.015, {}, source, listen).converged);
    const auto block = microphones.collect();
    if (base::rank(mesh.comm) != 0) continue;
    const auto modes = damped_modes(block.values, 1 / settings.step, {});
    for (int n = 1; n <= 5; ++n) {
      const double exact = (2 * n - 1) * settings.speed_of_sound / (4 * length);
      double nearest = 0;
      for (const DampedMode& mode : modes) {
        if (std::abs(mode.frequency() - exact) < std::abs(nearest - exact)) nearest = mode.frequency();
      }
      CHECK(std::abs(nearest / exact - 1) < 0.005);
    }
  }
}

TEST_CASE("a spherical open boundary close to the source lets a wave out that a plane one reflects") {
  // ψ = f(t - (r - r0) / c) / r, driven at r0; kR is about 0.75 at the middle of the spectrum.
  const double c = 350, density = 1.14, inner = 0.02, outer = 0.1, width = 0.38e-3;
  const auto f = [&](double t) { return std::exp(-std::pow((t - 5 * width) / width, 2) / 2); };
  const auto rate = [&](double t) { return -(t - 5 * width) / (width * width) * f(t); };
  const SpaceTime pressure = [&](auto x, double t) {
    const double r = x.size() == 3 ? std::hypot(x[0], x[1], x[2]) : std::hypot(x[0], x[1]);
    return density * rate(t - (r - inner) / c) / r;
  };
  const mesh::Mesh mesh = sector(3, inner, outer, 30);
  std::vector<double> errors;
  for (const double radius : {outer, 0.0}) {
    AcousticSettings settings;
    settings.density = density;
    settings.speed_of_sound = c;
    settings.step = 1e-5;
    settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::open, 0, radius}};
    AcousticSolver solver(mesh, settings);
    Source source;
    source.flux = [&](double t) { return rate(t) / (c * inner) + f(t) / (inner * inner); };
    double difference = 0, scale = 0;
    for (int n = 0; n < 40; ++n) {
      CHECK(solver.advance(1e-4, {}, source).converged);
      for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
        const double exact = pressure(std::span(mesh.point(v), 3), solver.state().time);
        difference += std::pow(solver.state().p[v] - exact, 2);
        scale += exact * exact;
      }
    }
    errors.push_back(std::sqrt(base::sum(mesh.comm, difference) / base::sum(mesh.comm, scale)));
  }
  print_errors("monopole, open boundary: spherical, plane", errors, false);
  CHECK(errors[0] < 0.02);
  CHECK(errors[1] > 10 * errors[0]);
}

TEST_CASE("a circular open boundary in two dimensions reflects less than a plane one") {
  // The reference is a ring so large that nothing comes back.
  const double c = 350, inner = 0.02, width = 0.3e-3;
  const auto record = [&](double outer, int cells, double radius) {
    const mesh::Mesh mesh = sector(2, inner, outer, cells);
    AcousticSettings settings;
    settings.speed_of_sound = c;
    settings.step = 1e-5;
    settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::open, 0, radius}};
    AcousticSolver solver(mesh, settings);
    Microphones microphones(mesh, {{"inside", {0.05, 0, 0}}});
    Source source;
    source.flux = [&](double t) {
      return -(t - 5 * width) / width * std::exp(-std::pow((t - 5 * width) / width, 2) / 2);
    };
    CHECK(solver.advance(4e-3, {}, source, [&](double t) { microphones.sample(t, solver.state().p); }).converged);
    return microphones.collect().values;
  };
  const auto reference = record(0.82, 300, 0);
  std::vector<double> errors;
  for (const double radius : {0.1, 0.0}) {
    const auto series = record(0.1, 30, radius);
    double difference = 0, scale = 0;
    for (std::size_t i = 0; i < series.size(); ++i) {
      difference += std::pow(series[i] - reference[i], 2);
      scale += reference[i] * reference[i];
    }
    errors.push_back(std::sqrt(difference / std::max(scale, 1e-300)));
  }
  print_errors("line source, open boundary: circular, plane", errors, false);
  if (base::rank(MPI_COMM_WORLD) == 0) CHECK(errors[0] < 0.5 * errors[1]);
}

}  // namespace vocalis::acoustic::verification
