#include "acoustic_solver/explicit_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/row_order.hpp"
#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {

using namespace test;

namespace {

using std::numbers::pi;

/// One period of it lasts 2.
State standing_wave(const mesh::Mesh& mesh) {
  State state;
  state.psi.assign(mesh.num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) state.p.push_back(std::cos(pi * mesh.point(v)[0]));
  return state;
}

/// Something of all modes of the mesh.
State noise(const mesh::Mesh& mesh) {
  State state;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double number = static_cast<double>(mesh.vertex_input[v]);
    state.p.push_back(std::sin(12.9898 * number * number));
    state.psi.push_back(0);
  }
  return state;
}

double product(const mesh::Mesh& mesh, const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) sum += a[v] * b[v];
  return base::sum(mesh.comm, sum);
}

/// Leap-frog on one mesh, at a part of its stable step.
struct LeapFrog {
  LeapFrog(int dimension, double part_of_stable_step)
      : mesh(unit_box(MPI_COMM_WORLD, dimension, 8)),
        settings(unit_medium(1, Integrator::leap_frog)),
        space(fem::lagrange(mesh, 1)),
        wave(mesh, space, settings),
        integrator(mesh, space, wave, settings.density),
        state(noise(mesh)) {
    step.dt = part_of_stable_step * integrator.stable_step(false);
  }
  /// Sub-steps of `step.dt`, together.
  void advance(int count) {
    SubStep together = step;
    together.dt = count * step.dt;
    finite = finite && integrator.advance(together, count, state, report);
  }

  /// What the scheme conserves to the last bits, ½ |p/ρ|²_K + ½ (p⁻ - p) / (ρ dt) · K ψ⁺, with p of the step before and
  /// ψ half a step later: the energy of the rates, in whose terms no mass needs to be inverted.
  double conserved(const std::vector<double>& pressure_before) {
    const std::size_t n = state.p.size();
    std::vector<double> rate(n), force_of_rate(n, 0.0), acceleration(n), later(n), force(n, 0.0);
    for (std::size_t v = 0; v < n; ++v) {
      rate[v] = state.p[v] / settings.density;
      acceleration[v] = (pressure_before[v] - state.p[v]) / (settings.density * step.dt);
      later[v] = state.psi[v] + 0.5 * step.dt * rate[v];
    }
    wave.add_stiffness(1, rate, force_of_rate);
    wave.add_stiffness(1, later, force);
    space.halo.add_to_owners(force_of_rate);
    space.halo.add_to_owners(force);
    return 0.5 * (product(mesh, rate, force_of_rate) + product(mesh, acceleration, force));
  }

  mesh::Mesh mesh;
  AcousticSettings settings;
  fem::Space space;
  WaveOperator wave;
  ExplicitStep integrator;
  State state;
  SubStep step;
  AdvanceReport report;
  bool finite = true;
};

/// Mean of the energy over ten periods of the standing wave.
double mean_energy(AcousticSolver& solver) {
  double sum = 0;
  for (int n = 0; n < 200; ++n) {
    solver.advance(0.1);
    sum += solver.energy() / 200;
  }
  return sum;
}

}  // namespace

TEST_CASE("the energy of a rigid cavity changes by less than 1e-3 in a thousand periods, by either integrator",
          "[serial]") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, dimension, 8);
    for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
      AcousticSolver solver(mesh, unit_medium(0.1, integrator));
      solver.set_state(standing_wave(mesh));
      const double first = mean_energy(solver);
      CHECK(solver.advance(1960).converged);
      const double change = std::abs(mean_energy(solver) / first - 1);
      INFO("change " << change);
      CHECK(change < 1e-3);
    }
  }
}

TEST_CASE("the leap-frog conserves an energy of its own to rounding, at all frequencies of the mesh") {
  for (const int dimension : {2, 3}) {
    LeapFrog run(dimension, 0.9);
    double first = 0, largest = 0;
    for (int n = 0; n < 100; ++n) {
      const std::vector<double> before = run.state.p;
      run.advance(1);
      const double now = run.conserved(before);
      if (n == 0) first = now;
      largest = std::max(largest, std::abs(now / first - 1));
    }
    CHECK(run.finite);
    CHECK(first > 0);
    CHECK(largest < 1e-10);
  }
}

TEST_CASE("inside its stable step the leap-frog is bounded, beyond it grows without bound") {
  for (const int dimension : {2, 3}) {
    const auto growth = [&](double part) {
      LeapFrog run(dimension, part);
      const double before = std::sqrt(product(run.mesh, run.state.p, run.state.p));
      run.advance(150);
      if (!run.finite) return std::numeric_limits<double>::infinity();
      return std::sqrt(product(run.mesh, run.state.p, run.state.p)) / before;
    };
    CHECK(growth(0.99) < 10);
    CHECK(growth(1.15) > 1e6);
  }
}

TEST_CASE("the bound of the stable step is below the step and not far from it") {
  for (const int dimension : {2, 3}) {
    LeapFrog run(dimension, 1);
    const double part = run.integrator.stable_step(true) / run.step.dt;
    CHECK(part <= 1);
    CHECK(part > 0.8);
  }
}

TEST_CASE("reverse Cuthill-McKee brings the nodes of a shuffled chain into a row", "[serial]") {
  // 3 - 0 - 4 - 1 - 2, and 5 alone; column 7 is no node.
  const std::vector<std::int32_t> starts = {0, 2, 4, 5, 7, 9, 9}, columns = {3, 4, 4, 2, 1, 0, 7, 0, 1};
  CHECK(reverse_cuthill_mckee(starts, columns) == std::vector<std::int32_t>{5, 3, 0, 4, 1, 2});
}

}  // namespace vocalis::acoustic
