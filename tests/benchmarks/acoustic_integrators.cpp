// Times one simulated millisecond of sound by the explicit integrator and by the implicit one, with several
// preconditioners, on a horn in space and one in the plane whose cells grow from the
// glottis to the open air. Run with the release preset:  mpirun -n 2 benchmark_acoustic_integrators
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <random>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/microphones.hpp"
#include "acoustic_solver/pulse.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/la/petsc.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

struct Horn {
  int dimension, across, layers;
  double finest, coarsest;  ///< cell length at the narrow and the wide end [m]
  double step;              ///< of the implicit integrator [s]
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

/// A fifth of a simulated millisecond in the product, after the pulse has entered; the time is that of a whole one.
void time_integrator(const Horn& horn, const mesh::Mesh& mesh, Integrator integrator,
                     const std::vector<std::string>& options, bool moves) {
  for (std::size_t i = 0; i < options.size(); i += 2) {
    base::check(PetscOptionsSetValue(nullptr, options[i].c_str(), options[i + 1].c_str()));
  }
  AcousticSolver solver(mesh, air(horn.step, integrator));
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
  const auto run = [&](double duration) {
    AdvanceReport total;
    const int steps = static_cast<int>(std::lround(duration / horn.step));
    for (int n = 0; n < steps; ++n) {
      const double t = solver.state().time;
      const auto from = coordinates_at(t), to = coordinates_at(t + horn.step);
      const AdvanceReport report = solver.advance(horn.step, moves ? Motion{from, to} : Motion{}, source);
      if (!report.converged) say("  not converged: " + report.reason);
      total.sub_steps += report.sub_steps;
      total.linear_iterations += report.linear_iterations;
      total.passes += report.passes;
    }
    return total;
  };
  run(0.4e-3);
  const auto start = std::chrono::steady_clock::now();
  const AdvanceReport report = run(0.2e-3);
  const double seconds = 5 * base::largest(mesh.comm, seconds_since(start));
  std::string name = moves ? "moving " : "still  ";
  for (const std::string& option : options) name += " " + option;
  say(fmt::format("  {}, dt {:.1e} s: {:7.3f} s; a step {:6.2f} ms, {:5.1f} iterations, {:.2f} passes; {}",
                  integrator == Integrator::implicit ? "implicit" : "explicit", 0.2e-3 / report.sub_steps, seconds,
                  200 * seconds / report.sub_steps, static_cast<double>(report.linear_iterations) / report.sub_steps,
                  static_cast<double>(report.passes) / report.sub_steps, name));
  for (std::size_t i = 0; i < options.size(); i += 2) {
    base::check(PetscOptionsClearValue(nullptr, options[i].c_str()));
  }
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis::acoustic;
  const vocalis::base::Session session(argc, argv);
  const Horn space = {3, 14, 178, 0.8e-3, 6e-3, 1e-5}, plane = {2, 20, 380, 0.08e-3, 5e-3, 5e-6};
  for (const Horn& horn : {space, plane}) {
    const vocalis::mesh::Mesh mesh = build(horn);
    say(fmt::format("{}-D, {} vertices, {:.2g} to {:.2g} mm, on {} ranks: wall time of one simulated millisecond",
                    horn.dimension, mesh.vertices.num_global, 1e3 * horn.finest, 1e3 * horn.coarsest,
                    vocalis::base::size(mesh.comm)));
    for (const bool moves : {false, true}) {
      time_integrator(horn, mesh, Integrator::leap_frog, {}, moves);
      time_integrator(horn, mesh, Integrator::implicit, {}, moves);
      time_integrator(horn, mesh, Integrator::implicit, {"-acoustic_ksp_rtol", "1e-6"}, moves);
      time_integrator(horn, mesh, Integrator::implicit, {"-acoustic_pc_type", "jacobi"}, moves);
      time_integrator(horn, mesh, Integrator::implicit, {"-acoustic_pc_type", "eisenstat"}, moves);
      time_integrator(horn, mesh, Integrator::implicit,
                      {"-acoustic_pc_type", "bjacobi", "-acoustic_sub_pc_type", "icc"}, moves);
      time_integrator(horn, mesh, Integrator::implicit,
                      {"-acoustic_pc_type", "bjacobi", "-acoustic_sub_pc_type", "cholesky"}, moves);
      time_integrator(horn, mesh, Integrator::implicit,
                      {"-acoustic_pc_type", "hypre", "-acoustic_pc_hypre_type", "boomeramg"}, moves);
    }
  }
}
