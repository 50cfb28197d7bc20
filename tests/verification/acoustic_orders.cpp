#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using std::numbers::pi;
constexpr double kDensity = 2, kSpeed = 1.5;
constexpr double kFrequency = 2.2;  // rad/s: no resonance, so that the source matters

double shape(std::span<const double> x) {
  double value = 1;
  for (const double coordinate : x) value *= std::cos(pi * coordinate);
  return value;
}
// ψ = (1 - cos ωt)² cos(πx) cos(πy) [cos(πz)]: ∇ψ·n = 0 on the walls of the unit box, and everything begins so smoothly
// that no other mode of the mesh is excited.
double growth(double t) { return std::pow(1 - std::cos(kFrequency * t), 2); }
double growth_rate(double t) { return 2 * kFrequency * (1 - std::cos(kFrequency * t)) * std::sin(kFrequency * t); }
double growth_second_rate(double t) {
  return 2 * kFrequency * kFrequency * (std::cos(kFrequency * t) - std::cos(2 * kFrequency * t));
}
double potential(std::span<const double> x, double t) { return growth(t) * shape(x); }
double pressure(std::span<const double> x, double t) { return kDensity * growth_rate(t) * shape(x); }
double source(std::span<const double> x, double t) {
  const double from_velocity = static_cast<double>(x.size()) * pi * pi * growth(t);
  return (growth_second_rate(t) / (kSpeed * kSpeed) + from_velocity) * shape(x);
}

/// The vertices inside of the box swing; the walls stay.
std::vector<double> coordinates_at(const mesh::Mesh& mesh, const std::vector<double>& reference, double amplitude,
                                   double t) {
  const int d = mesh.dimension;
  std::vector<double> result = reference;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double bubble = amplitude * std::sin(4 * t);
    for (int k = 0; k < d; ++k) bubble *= std::sin(pi * reference[static_cast<std::size_t>(v) * d + k]);
    for (int k = 0; k < d; ++k) result[static_cast<std::size_t>(v) * d + k] += (k == 0 ? 1 : -0.6) * bubble;
  }
  return result;
}

/// Pressure after time 1 in steps of which each is a sub-step; the mesh swings by `amplitude`.
struct Run {
  mesh::Mesh mesh;
  double error = 0;
  std::vector<double> p;
};
Run run(int dimension, int cells, int steps, double amplitude, Integrator integrator, double spectral_radius = 1) {
  Run result = {box_mesh({1, 1, dimension == 3 ? 1.0 : 0.0}, {cells, cells, cells}), 0, {}};
  mesh::Mesh& mesh = result.mesh;
  const std::vector<double> reference = mesh.coordinates;
  AcousticSettings settings;
  settings.density = kDensity;
  settings.speed_of_sound = kSpeed;
  settings.step = 1.0 / steps;
  settings.solver_tolerance = 1e-9;
  settings.integrator = integrator;
  settings.spectral_radius = spectral_radius;
  AcousticSolver solver(mesh, settings);
  solver.set_state(state_of(mesh, pressure, potential, 0));
  for (int n = 0; n < steps; ++n) {
    const double begin = n * settings.step, end = (n + 1) * settings.step;
    const auto from = coordinates_at(mesh, reference, amplitude, begin);
    const auto to = coordinates_at(mesh, reference, amplitude, end);
    const fem::Load first = load_of(solver.space(), from, source, begin);
    const fem::Load second = load_of(solver.space(), to, source, end);
    CHECK(solver.advance(settings.step, {from, to}, {&first, &second, {}}).converged);
    mesh.coordinates = to;
  }
  result.error = relative_error(solver, pressure);
  result.p = solver.state().p;
  return result;
}

double distance(const Run& a, const Run& b) {
  double square = 0, scale = 0;
  for (std::int32_t v = 0; v < a.mesh.vertices.num_owned; ++v) {
    square += std::pow(a.p[v] - b.p[v], 2);
    scale += std::pow(b.p[v], 2);
  }
  return std::sqrt(base::sum(a.mesh.comm, square) / base::sum(a.mesh.comm, scale));
}

}  // namespace

TEST_CASE("acoustic pressure converges with order 2 in space, on a mesh that stands still and on one that swings") {
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    const std::string by = integrator == Integrator::implicit ? "implicit" : "explicit";
    for (const double amplitude : {0.0, 0.08}) {
      const std::string mesh = amplitude == 0 ? "still" : "swinging";
      std::vector<double> plane, solid;
      for (const int cells : {8, 16, 32}) plane.push_back(run(2, cells, 160, amplitude, integrator).error);
      for (const int cells : {4, 8, 16}) solid.push_back(run(3, cells, 80, amplitude, integrator).error);
      print_errors(("space, 2-D, " + mesh + ", " + by).c_str(), plane);
      print_errors(("space, 3-D, " + mesh + ", " + by).c_str(), solid);
      CHECK(std::log2(plane[1] / plane[2]) == Approx(2).margin(0.2));
      CHECK(std::log2(solid[1] / solid[2]) == Approx(2).margin(0.2));
    }
  }
}

TEST_CASE("acoustic pressure converges with order 2 in time, on a mesh that stands still and on one that swings") {
  struct Scheme {
    std::string words;
    Integrator integrator;
    double spectral_radius;
    int steps;  ///< of the longest; the explicit ones are inside of the stable one, so that none is divided
  };
  for (const Scheme& scheme : {Scheme{"implicit", Integrator::implicit, 1, 20},
                               Scheme{"implicit, spectral radius 0.8", Integrator::implicit, 0.8, 20},
                               Scheme{"explicit", Integrator::leap_frog, 1, 60}}) {
    for (const double amplitude : {0.0, 0.08}) {
      const auto run_in = [&](int steps) {
        return run(2, 12, steps, amplitude, scheme.integrator, scheme.spectral_radius);
      };
      const Run reference = run_in(32 * scheme.steps);
      std::vector<double> errors;
      for (const int factor : {1, 2, 4}) errors.push_back(distance(run_in(factor * scheme.steps), reference));
      const std::string title = fmt::format("time, 2-D, {}, {}", amplitude == 0 ? "still" : "swinging", scheme.words);
      print_errors(title.c_str(), errors);
      CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.2));
    }
  }
}

}  // namespace vocalis::acoustic::verification
