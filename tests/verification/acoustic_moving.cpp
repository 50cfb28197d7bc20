#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using std::numbers::pi;

AcousticSettings unit_medium(double step) {
  AcousticSettings settings;
  settings.density = 1;
  settings.speed_of_sound = 1;
  settings.step = step;
  return settings;
}

/// Sound in a cavity 0 < x < 1 + v t with hard ends, u·n = 0 on the wall that moves too.
/// Source: Moore 1970, J. Math. Phys. 11 (the function R of a uniformly moving mirror).
struct MovingCavity {
  double v = -0.1;
  int n = 2;
  double length(double t) const { return 1 + v * t; }
  double exponent() const { return n * pi * 2 / std::log((1 + v) / (1 - v)); }
  double wave(double z) const { return std::sin(exponent() * std::log(1 + v * z)); }
  double integral(double z) const {
    const double s = 1 + v * z, a = exponent(), angle = a * std::log(s);
    return s / v * (std::sin(angle) - a * std::cos(angle)) / (1 + a * a);
  }
  double pressure(double x, double t) const { return -wave(t + x) - wave(t - x); }
  double potential(double x, double t) const { return -integral(t + x) - integral(t - x); }
};

}  // namespace

TEST_CASE("V7: sound in a cavity whose hard end moves converges with order 2") {
  // The step is h / 4: at h / 2 the errors of space and time nearly cancel, and what remains is the noise, v / c times
  // O(h), of ∇ψ at vertices whose cells lie to one side.
  const MovingCavity cavity;
  for (const int dimension : {2, 3}) {
    const SpaceTime pressure = [&](auto x, double t) { return cavity.pressure(x[0], t); };
    const SpaceTime potential = [&](auto x, double t) { return cavity.potential(x[0], t); };
    std::vector<double> errors;
    for (const int cells : dimension == 2 ? std::vector{20, 40, 80} : std::vector{20, 40}) {
      const double h = 1.0 / cells;
      mesh::Mesh mesh = box_mesh({1, 2 * h, dimension == 3 ? 2 * h : 0}, {cells, 2, 2});
      const std::vector<double> reference = mesh.coordinates;
      const auto at = [&](double t) {
        std::vector<double> result = reference;
        for (std::size_t i = 0; i < result.size(); i += dimension) result[i] *= cavity.length(t);
        return result;
      };
      const int steps = 16 * cells;
      const double dt = 4.0 / steps;
      AcousticSolver solver(mesh, unit_medium(dt));
      solver.set_state(state_of(mesh, pressure, potential, 0));
      for (int step = 0; step < steps; ++step) {
        const auto from = at(step * dt), to = at((step + 1) * dt);
        CHECK(solver.advance(dt, {from, to}).converged);
        mesh.coordinates = to;
      }
      errors.push_back(relative_error(solver, pressure));
    }
    print_errors(dimension == 2 ? "V7 cavity, moving hard end, 2-D" : "V7 cavity, moving hard end, 3-D", errors);
    CHECK(lowest_order(errors) == Approx(2).margin(0.2));
  }
}

TEST_CASE("a plane wave does not feel an inner block of the mesh that moves through it") {
  for (const int dimension : {2, 3}) {
    const SpaceTime pressure = [](auto x, double t) { return std::cos(2 * pi * x[0]) * std::cos(2 * pi * t); };
    const SpaceTime potential = [](auto x, double t) {
      return std::cos(2 * pi * x[0]) * std::sin(2 * pi * t) / (2 * pi);
    };
    std::vector<double> still, moving;
    for (const int cells : dimension == 2 ? std::vector{16, 32, 64} : std::vector{8, 16, 32}) {
      for (const double speed : {0.0, 0.06}) {
        const int across = cells / 2;
        const double width = 0.5;
        mesh::Mesh mesh = box_mesh({1, width, dimension == 3 ? width : 0}, {cells, across, across});
        const std::vector<double> reference = mesh.coordinates;
        const auto at = [&](double t) {
          std::vector<double> result = reference;
          for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
            double* x = result.data() + static_cast<std::size_t>(v) * dimension;
            double inside = std::min({1.0, 4 * x[0], 4 * (1 - x[0])});
            for (int k = 1; k < dimension; ++k) inside = std::min({inside, 4 * x[k] / width, 4 * (1 - x[k] / width)});
            x[0] += inside * speed * t;
          }
          return result;
        };
        const int steps = 2 * cells;
        const double dt = 1.2 / steps;
        AcousticSolver solver(mesh, unit_medium(dt));
        solver.set_state(state_of(mesh, pressure, potential, 0));
        for (int step = 0; step < steps; ++step) {
          const auto from = at(step * dt), to = at((step + 1) * dt);
          CHECK(solver.advance(dt, {from, to}).converged);
          mesh.coordinates = to;
        }
        (speed == 0 ? still : moving).push_back(relative_error(solver, pressure));
      }
    }
    print_errors(dimension == 2 ? "plane wave, still mesh, 2-D" : "plane wave, still mesh, 3-D", still);
    print_errors(dimension == 2 ? "plane wave, block moving through it, 2-D" : "plane wave, block moving, 3-D", moving);
    CHECK(std::log2(moving[1] / moving[2]) > 1.8);
    CHECK(moving.back() < 2 * still.back());
  }
}

}  // namespace vocalis::acoustic::verification
