// Times a step of sound by both integrators, on a horn in space and one in the plane whose cells grow from the glottis
// to the open air, at several steps of the case: what an implicit step costs in explicit sub-steps, which decides
// `integrator = "auto"`. Run with the release preset:  mpirun -n 1 benchmark_acoustic_integrators
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <random>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/pulse.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

struct Horn {
  int dimension, across, layers;
  double finest, coarsest;  ///< cell length at the narrow and the wide end [m]
};

mesh::Mesh build(const Horn& horn) {
  const int d = horn.dimension;
  mesh::WholeMesh whole =
      mesh::box(MPI_COMM_WORLD, {1.0 * horn.layers, 1.0 * horn.across, d == 3 ? 1.0 * horn.across : 0.0},
                {horn.layers, horn.across, horn.across});
  const double growth = std::log(horn.coarsest / horn.finest) / horn.layers;
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> shift(-0.15, 0.15);
  for (std::size_t v = 0; v < whole.coordinates.size(); v += d) {
    double* x = whole.coordinates.data() + v;
    bool inside = x[0] > 0.5 && x[0] < horn.layers - 0.5;
    for (int k = 1; k < d; ++k) inside = inside && x[k] > 0.5 && x[k] < horn.across - 0.5;
    for (int k = 0; k < d; ++k) x[k] += inside ? shift(generator) : 0;
    const double h = horn.finest * std::exp(growth * x[0]);
    x[0] = (h - horn.finest) / growth;
    for (int k = 1; k < d; ++k) x[k] = h * (x[k] - 0.5 * horn.across);
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

AcousticSettings air(double step, Integrator integrator) {
  AcousticSettings settings;
  settings.integrator = integrator;
  settings.step = step;
  settings.wall_admittance = 0.005;
  settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::open}};
  return settings;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void say(const std::string& text) {
  if (base::rank(MPI_COMM_WORLD) == 0) {
    fmt::print("{}\n", text);
    std::fflush(stdout);
  }
}

/// Seconds of a step of the case, and what it took.
struct Cost {
  double seconds = 0, sub_steps = 0, iterations = 0;
};

/// A mean over steps after the pulse has entered.
Cost cost(const Horn& horn, const mesh::Mesh& mesh, Integrator integrator, double dt, bool moves) {
  AcousticSolver solver(mesh, air(dt, integrator));
  const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 5000});
  const Source source = {nullptr, nullptr, [&](double t) { return pulse.value(t); }};
  // The narrow sixth swings at 200 Hz by a tenth of its width, as the air between the folds does.
  const double end = (horn.coarsest - horn.finest) / std::log(horn.coarsest / horn.finest) * horn.layers;
  const auto coordinates_at = [&](double t) {
    std::vector<double> result = mesh.coordinates;
    for (std::size_t v = 0; v < result.size(); v += horn.dimension) {
      const double s = 6 * result[v] / end;
      if (s > 0 && s < 1) result[v + 1] *= 1 + 0.1 * std::sin(400 * M_PI * t) * std::pow(std::sin(M_PI * s), 2);
    }
    return result;
  };
  Cost mean;
  const auto run = [&](int steps) {
    for (int n = 0; n < steps; ++n) {
      const double t = solver.state().time;
      const auto from = coordinates_at(t), to = coordinates_at(t + dt);
      const auto start = std::chrono::steady_clock::now();
      const AdvanceReport report = solver.advance(dt, moves ? Motion{from, to} : Motion{}, source);
      mean.seconds += base::largest(mesh.comm, seconds_since(start)) / steps;
      mean.sub_steps += static_cast<double>(report.sub_steps) / steps;
      mean.iterations += static_cast<double>(report.linear_iterations) / steps;
      if (!report.converged) say("  not converged: " + report.reason);
    }
  };
  run(8);
  mean = {};
  run(moves ? 8 : 20);
  return mean;
}

void compare(const Horn& horn, const mesh::Mesh& mesh, double dt, bool moves) {
  const Cost leap_frog = cost(horn, mesh, Integrator::leap_frog, dt, moves);
  const Cost implicit = cost(horn, mesh, Integrator::implicit, dt, moves);
  const double sub_step = leap_frog.seconds / leap_frog.sub_steps;
  say(fmt::format(
      "  {} {:.1e} s: explicit {:8.2f} ms ({:.0f} x {:.2f}), implicit {:7.2f} ms ({:.0f} iterations), "
      "{:5.1f} sub-steps; explicit costs {:.2f} of implicit",
      moves ? "moving" : "still ", dt, 1e3 * leap_frog.seconds, leap_frog.sub_steps, 1e3 * sub_step,
      1e3 * implicit.seconds, implicit.iterations, implicit.seconds / sub_step, leap_frog.seconds / implicit.seconds));
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis::acoustic;
  const vocalis::base::Session session(argc, argv);
  const Horn space = {3, 14, 178, 0.8e-3, 6e-3}, plane = {2, 20, 380, 0.08e-3, 5e-3};
  for (const Horn& horn : {space, plane}) {
    const vocalis::mesh::Mesh mesh = build(horn);
    say(fmt::format("{}-D, {} vertices, cells of {:.2g} to {:.2g} mm, {} ranks: wall time of a step", horn.dimension,
                    mesh.vertices.num_global, 1e3 * horn.finest, 1e3 * horn.coarsest, vocalis::base::size(mesh.comm)));
    for (const bool moves : {false, true}) {
      for (const double dt : {1e-6, 3e-6, 1e-5, 3e-5}) compare(horn, mesh, dt, moves);
    }
  }
}
