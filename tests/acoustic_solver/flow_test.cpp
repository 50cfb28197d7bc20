#include <cmath>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/wave_operator.hpp"
#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {

using namespace test;

namespace {

using std::numbers::pi;

constexpr AcousticBoundaryKind kReleased = AcousticBoundaryKind::pressure_release;

/// Along x, with shear, through both ends.
std::vector<double> jet(const mesh::Mesh& mesh, double speed) {
  std::vector<double> result(mesh.coordinates.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    result[static_cast<std::size_t>(v) * mesh.dimension] =
        speed / std::pow(std::cosh((mesh.point(v)[1] - 0.25) / 0.1), 2);
  }
  return result;
}

/// H = E + (p, (β - U)·∇ψ) / c²
double flow_energy(const AcousticSolver& solver, const WaveOperator& wave) {
  const State& state = solver.state();
  std::vector<double> rates;
  wave.potential_convection(state.psi, state.p, rates);
  const std::vector<double> momentum = wave.momentum(state.p);
  double sum = 0;
  for (std::int32_t v = 0; v < solver.space().dofs.num_owned; ++v) sum += momentum[v] * rates[v];
  return solver.energy() + solver.settings().density * base::sum(solver.space().mesh->comm, sum);
}

/// Pressure at every vertex of the input mesh, with a jet on a mesh that moves and then stands still.
std::vector<double> run_everything(MPI_Comm comm, int dimension, Integrator integrator) {
  const mesh::Mesh mesh = unit_box(comm, dimension, 8);
  AcousticSettings settings = unit_medium(0.05, integrator);
  settings.wall_admittance = 0.1;
  settings.boundaries = {{"left", kReleased}, {"right", AcousticBoundaryKind::open, 0, 1.5}};
  AcousticSolver solver(mesh, settings);
  solver.set_state(bump(mesh));
  const std::vector<double> moved = deformed(mesh, 0.02);
  const std::vector<double> flow = jet(mesh, 0.2);
  bool converged = solver.advance(0.2, {mesh.coordinates, moved, flow}).converged;
  converged = converged && solver.advance(0.2, {moved, mesh.coordinates, flow}).converged;
  converged = converged && solver.advance(0.2, {{}, {}, flow}).converged;
  REQUIRE_ON_ALL_RANKS(converged);
  return by_input_number(mesh, solver.state().p);
}

}  // namespace

TEST_CASE("sound in a flow does not depend on the number of ranks") {
  for (const int dimension : {2, 3}) {
    for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
      const auto together = run_everything(MPI_COMM_WORLD, dimension, integrator);
      const auto alone = run_everything(MPI_COMM_SELF, dimension, integrator);
      CHECK(largest(alone) > 0.01);
      CHECK(largest_difference(alone, together) < 1e-8 * largest(alone));
    }
  }
}

TEST_CASE("a medium at rest and a flow of velocity 0 are the same to the last bit") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  const std::vector<double> zero(mesh.coordinates.size(), 0.0);
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    AcousticSolver with(mesh, unit_medium(0.05, integrator)), without(mesh, unit_medium(0.05, integrator));
    with.set_state(bump(mesh));
    without.set_state(bump(mesh));
    const AdvanceReport report = with.advance(0.5, {{}, {}, zero});
    CHECK(report.passes == (integrator == Integrator::implicit ? report.sub_steps : 0));
    without.advance(0.5);
    CHECK(with.state().p == without.state().p);
    CHECK(with.state().psi == without.state().psi);
  }
}

TEST_CASE("a steady flow keeps the energy of sound in it to the solver's tolerance, through rigid and released ends") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, dimension, 8);
    const std::vector<double> flow = jet(mesh, 0.3);
    for (const bool released : {false, true}) {
      for (const double step : {0.03, 1.0}) {
        AcousticSettings settings = unit_medium(step);
        if (released) settings.boundaries = {{"left", kReleased}, {"right", kReleased}};
        AcousticSolver solver(mesh, settings);
        WaveOperator wave(mesh, solver.space(), settings);
        wave.set_velocity({}, flow);
        solver.set_state(bump(mesh));
        CHECK(solver.advance(step, {{}, {}, flow}).converged);
        const double before = flow_energy(solver, wave), acoustic = solver.energy();
        CHECK(solver.advance(20 * step, {{}, {}, flow}).converged);
        INFO(dimension << "-D, step " << step << ", " << (released ? "released" : "rigid"));
        CHECK(std::abs(flow_energy(solver, wave) / before - 1) < 1e-7);
        CHECK(std::abs(solver.energy() / acoustic - 1) > 1e-5);
      }
    }
  }
}

TEST_CASE("the passes over the terms of a flow do not rise with its Courant number") {
  // Each leaves M + M² of the error: eight of them a part below 1e-7.
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 32);
  const std::vector<double> flow = jet(mesh, 0.115);
  for (const double courant_number : {0.1, 1.0, 5.0, 20.0, 100.0}) {
    AcousticSettings settings = unit_medium(courant_number / (32 * 0.115));
    settings.solver_tolerance = 1e-8;
    settings.boundaries = {{"left", AcousticBoundaryKind::open}, {"right", AcousticBoundaryKind::open}};
    AcousticSolver solver(mesh, settings);
    solver.set_state(bump(mesh));
    const AdvanceReport report = solver.advance(10 * settings.step, {{}, {}, flow});
    CHECK(report.converged);
    INFO(courant_number);
    CHECK(report.passes <= 8 * report.sub_steps);
  }
}

TEST_CASE("where the medium flows sound is advanced by the implicit integrator, unless the case says otherwise") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  const AcousticSolver solver(mesh, unit_medium(0.05, Integrator::automatic));
  CHECK(solver.choice(0.05, false).integrator == Integrator::leap_frog);
  CHECK(words(solver.choice(0.05, false, true)) == "implicit: the medium flows");
}

TEST_CASE("a flow inside an absorbing layer is refused") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  AcousticSettings settings = unit_medium(0.05);
  AbsorbingLayer layer;
  layer.sides = {BoxSide::x_max};
  layer.thickness = 0.25;
  settings.layers = {layer};
  AcousticSolver solver(mesh, settings);
  const std::vector<double> flow = jet(mesh, 0.1);
  CHECK_THROWS_WITH(solver.advance(0.05, {{}, {}, flow}), Catch::Contains("layers") && Catch::Contains("flows"));
  std::vector<double> in_front = flow;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.point(v)[0] > 0.7) in_front[2 * static_cast<std::size_t>(v)] = 0;
  }
  CHECK(solver.advance(0.05, {{}, {}, in_front}).converged);
}

}  // namespace vocalis::acoustic
