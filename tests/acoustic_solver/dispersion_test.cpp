#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

using std::numbers::pi;

/// A box of bricks of edge 1 cut into cells; vertices inside are shifted by up to `irregular` in each direction.
mesh::Mesh bricks(std::array<int, 3> cells, int dimension, double irregular) {
  const std::array<double, 3> size = {1.0 * cells[0], 1.0 * cells[1], dimension == 3 ? 1.0 * cells[2] : 0.0};
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, size, cells);
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> shift(-irregular, irregular);
  for (std::size_t v = 0; v < whole.coordinates.size(); v += dimension) {
    double* x = whole.coordinates.data() + v;
    bool inside = true;
    for (int k = 0; k < dimension; ++k) inside = inside && x[k] > 0.5 && x[k] < cells[k] - 0.5;
    for (int k = 0; k < dimension; ++k) x[k] += inside ? shift(generator) : 0;
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

struct Error {
  double frequency = 0;  ///< relative
  double loss = 0;       ///< of amplitude, a period
};

/// The standing wave of the given half waves along the box's edges, after some periods in a medium with c = ρ = 1:
/// p + iρωψ turns by ω a unit of time. With `time_too` Crank–Nicolson's own error counts.
Error error_of_wave(const mesh::Mesh& mesh, std::array<int, 3> cells, std::array<int, 3> half_waves, double step,
                    AcousticSettings settings, bool time_too) {
  settings.speed_of_sound = settings.density = 1;
  settings.step = step;
  AcousticSolver solver(mesh, settings);
  double square = 0;
  for (int k = 0; k < mesh.dimension; ++k) square += std::pow(pi * half_waves[k] / cells[k], 2);
  const double frequency = std::sqrt(square);
  State state;
  std::vector<double> weights;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double wave = 1, weight = 1;
    for (int k = 0; k < mesh.dimension; ++k) {
      const double x = mesh.point(v)[k];
      wave *= std::cos(pi * half_waves[k] * x / cells[k]);
      weight *= x < 1e-9 || x > cells[k] - 1e-9 ? 0.5 : 1;
    }
    state.p.push_back(wave);
    weights.push_back(weight * wave);
  }
  state.psi.assign(state.p.size(), 0.0);
  solver.set_state(state);
  const auto amplitude = [&] {
    double real = 0, imaginary = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      real += weights[v] * solver.state().p[v];
      imaginary += weights[v] * frequency * solver.state().psi[v];
    }
    return std::complex<double>(base::sum(mesh.comm, real), base::sum(mesh.comm, imaginary));
  };
  const std::complex<double> before = amplitude();
  const int periods = 3;
  const int steps = static_cast<int>(std::lround(2 * pi * periods / (frequency * step)));
  CHECK(solver.advance(steps * step).converged);
  const std::complex<double> turned = amplitude() / before * std::polar(1.0, -frequency * steps * step);
  double found = frequency + std::arg(turned) / (steps * step);
  if (!time_too) found = 2 / step * std::tan(found * step / 2);
  return {found / frequency - 1, 1 - std::pow(std::abs(turned), 1.0 / periods)};
}

}  // namespace

TEST_CASE("equal-order P1/P1 has the phase error and the losses of its one-dimensional analysis") {
  // Phase: sin(x) / x over the square root of both masses, x = 2π / nodes, the velocity's by its series; walls and the
  // finite box add up to two fifths. Loss: a period at the rate (τ / 2) c² (P⊥∇p)² / p².
  for (const int nodes : {8, 12, 20}) {
    const std::array<int, 3> cells = {nodes * 3, 10, 0};
    const mesh::Mesh mesh = bricks(cells, 2, 0);
    const double x = 2 * pi / nodes, mass = (2 + std::cos(x)) / 3;
    const double series = (1 - std::pow(1 - mass, 4)) / mass;
    const double exact = std::sin(x) / x * std::sqrt(series / mass) - 1;
    AcousticSettings settings;
    settings.velocity_elements = VelocityElements::p1;
    double without = 0;
    for (const double constant : {0.0, 0.02}) {
      settings.subscale_constant = constant;
      const Error error = error_of_wave(mesh, cells, {6, 0, 0}, nodes / 80.0, settings, false);
      const double damping = (2 - 2 * std::cos(x)) - std::pow(std::sin(x), 2) * series;
      const double loss = 1 - std::exp(-0.5 * constant * damping / mass * nodes);
      if (constant == 0) without = error.loss;
      CHECK(error.frequency / exact == Approx(1.2).epsilon(0.2));
      CHECK(error.loss - without == Approx(1.15 * loss).margin(0.25 * loss));
    }
  }
}

}  // namespace vocalis::acoustic
