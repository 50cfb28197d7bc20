#include <algorithm>
#include <cmath>
#include <limits>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {

using namespace test;

namespace {

/// Walls, an open end, a flux, a distributed source and a mesh that moves and then stands still together.
std::vector<double> run_everything(MPI_Comm comm, int dimension, Integrator integrator) {
  const mesh::Mesh mesh = unit_box(comm, dimension, 16);
  AcousticSettings settings = unit_medium(0.02, integrator);
  settings.wall_admittance = 0.1;
  settings.boundaries = {{"left", AcousticBoundaryKind::flux},
                         {"right", AcousticBoundaryKind::open, 0, 1.5},
                         {"top", AcousticBoundaryKind::pressure_release}};
  AcousticSolver solver(mesh, settings);
  fem::Load load(solver.space(), 1);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) load.values[v] = 1e-3 * mesh.point(v)[0];
  const Source source = {&load, &load, [](double t) { return std::sin(5 * t); }};
  const auto moved = deformed(mesh, 0.02);
  bool converged = true;
  for (int n = 0; n < 5; ++n) {
    const bool forth = n % 2 == 0;
    const Motion motion = forth ? Motion{mesh.coordinates, moved} : Motion{moved, mesh.coordinates};
    const AdvanceReport report = solver.advance(0.1, motion, source);
    converged = converged && report.converged && report.sub_steps >= 5;
    converged = converged && (integrator == Integrator::implicit ? report.passes > 5 : report.passes == 0);
  }
  converged = converged && solver.advance(0.1, {}, source).converged;
  REQUIRE_ON_ALL_RANKS(converged);
  return by_input_number(mesh, solver.state().p);
}

}  // namespace

TEST_CASE("sound does not depend on the number of ranks") {
  for (const auto& [dimension, integrator] :
       {std::pair(2, Integrator::implicit), std::pair(3, Integrator::implicit), std::pair(2, Integrator::leap_frog),
        std::pair(3, Integrator::leap_frog)}) {
    const auto alone = run_everything(MPI_COMM_SELF, dimension, integrator);
    const auto together = run_everything(MPI_COMM_WORLD, dimension, integrator);
    REQUIRE_ON_ALL_RANKS(alone.size() == together.size());
    CHECK(largest(alone) > 0.1);
    CHECK(largest_difference(alone, together) < 1e-10 * largest(alone));
  }
}

TEST_CASE("a closed cavity keeps its energy over a thousand steps, and only with a spectral radius of 1") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, dimension, 8);
    for (const double radius : {1.0, 0.5}) {
      AcousticSettings settings = unit_medium(0.05);
      settings.spectral_radius = radius;
      AcousticSolver solver(mesh, settings);
      solver.set_state(bump(mesh));
      const double before = solver.energy();
      const AdvanceReport report = solver.advance(50);
      REQUIRE_ON_ALL_RANKS(report.converged);
      CHECK(report.sub_steps == 1000);
      CHECK(report.passes == 1000);
      const double change = std::abs(solver.energy() / before - 1);
      if (radius == 1) CHECK(change < 1e-9);
      if (radius == 0.5) CHECK(change > 1e-3);
    }
  }
}

TEST_CASE("walls that admit sound, and an open end, take energy at every step") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 16);
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    std::vector<double> left_over;
    for (const double admittance : {0.01, 0.1}) {
      AcousticSettings settings = unit_medium(0.05, integrator);
      settings.wall_admittance = admittance;
      AcousticSolver solver(mesh, settings);
      solver.set_state(bump(mesh));
      const double start = solver.energy();
      double before = start;
      bool decays = true;
      for (int n = 0; n < 60; ++n) {
        solver.advance(0.05);
        const double now = solver.energy();
        // The leap-frog loses energy of its own kind at every step; this one swings by (ω dt)².
        decays = decays && now < before * (integrator == Integrator::implicit ? 1 : 1.05);
        before = now;
      }
      CHECK(decays);
      left_over.push_back(before / start);
    }
    CHECK(left_over[0] > 0.5);
    CHECK(left_over[1] < 0.3);
    AcousticSettings settings = unit_medium(0.05, integrator);
    settings.boundaries = {{"right", AcousticBoundaryKind::open}};
    AcousticSolver solver(mesh, settings);
    solver.set_state(bump(mesh));
    const double start = solver.energy();
    solver.advance(3);
    CHECK(solver.energy() < 0.7 * start);
  }
}

TEST_CASE("a run that goes on from its state equals the run that was not interrupted, to the last bit") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 3, 8);
  const auto moved = deformed(mesh, 0.02);
  const auto steps = [&](AcousticSolver& solver, int first, int last) {
    for (int n = first; n < last; ++n) {
      const Motion motion = n % 2 == 0 ? Motion{mesh.coordinates, moved} : Motion{moved, mesh.coordinates};
      solver.advance(0.05, n % 3 == 2 ? Motion{motion.end, motion.end} : motion);
    }
  };
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog, Integrator::automatic}) {
    AcousticSettings settings = unit_medium(0.02, integrator);
    settings.wall_admittance = 0.05;
    if (integrator == Integrator::implicit) settings.spectral_radius = 0.8;
    AcousticSolver whole(mesh, settings), first(mesh, settings), second(mesh, settings);
    whole.set_state(bump(mesh));
    steps(whole, 0, 4);
    whole.drop_caches();
    steps(whole, 4, 8);
    first.set_state(bump(mesh));
    steps(first, 0, 4);
    second.set_state(first.state());
    steps(second, 4, 8);
    CHECK(second.state().time == whole.state().time);
    CHECK(second.state().p == whole.state().p);
    CHECK(second.state().psi == whole.state().psi);
  }
}

TEST_CASE("the energy of a cavity does not grow in sixty crossings while its inside swings at a tenth of c") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 12);
  AcousticSolver solver(mesh, unit_medium(0.05));
  solver.set_state(bump(mesh));
  const double before = solver.energy();
  const auto moved = deformed(mesh, 0.02);
  int passes = 0;
  double largest = 0;
  for (int n = 0; n < 300; ++n) {
    const Motion motion = n % 2 == 0 ? Motion{mesh.coordinates, moved} : Motion{moved, mesh.coordinates};
    passes += solver.advance(0.2, motion).passes;
    largest = std::max(largest, std::abs(solver.energy() / before - 1));
  }
  CHECK(passes > 1200);
  CHECK(largest < 0.02);
  // A motion whose ends are equal is no motion.
  CHECK(solver.advance(0.1, Motion{mesh.coordinates, mesh.coordinates}).passes == 2);
}

TEST_CASE("wrong settings are the user's mistake, told by rule, value and remedy") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 4);
  AcousticSettings no_step = unit_medium(0);
  CHECK_THROWS_AS(AcousticSolver(mesh, no_step), base::UserError);
  AcousticSettings no_group = unit_medium(0.1);
  no_group.boundaries = {{"lips", AcousticBoundaryKind::open}};
  CHECK_THROWS_WITH(AcousticSolver(mesh, no_group), Catch::Contains("lips") && Catch::Contains("left"));
  AcousticSettings gains = unit_medium(0.1);
  gains.wall_admittance = -1;
  CHECK_THROWS_AS(AcousticSolver(mesh, gains), base::UserError);
  AcousticSettings grows = unit_medium(0.1);
  grows.spectral_radius = 1.1;
  CHECK_THROWS_AS(AcousticSolver(mesh, grows), base::UserError);
}

TEST_CASE("the spectral radius and the choice of the integrator go together") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  AcousticSettings settings = unit_medium(0.05, Integrator::automatic);
  CHECK(AcousticSolver(mesh, settings).choice(0.05, false).integrator == Integrator::leap_frog);
  settings.step = 100;
  CHECK(AcousticSolver(mesh, settings).choice(100, false).integrator == Integrator::implicit);
  CHECK(AcousticSolver(mesh, settings).choice(0.05, false).integrator == Integrator::leap_frog);
  settings.spectral_radius = 0.8;
  CHECK(AcousticSolver(mesh, settings).choice(0.05, false).integrator == Integrator::implicit);
  settings.integrator = Integrator::leap_frog;
  CHECK_THROWS_AS(AcousticSolver(mesh, settings), base::UserError);
}

TEST_CASE("absorbing layers are for the implicit integrator, and the automatic choice knows") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  AcousticSettings settings = unit_medium(0.05, Integrator::automatic);
  settings.layers = {{LayerKind::pml, {BoxSide::x_max}, 0.25}};
  const IntegratorChoice choice = AcousticSolver(mesh, settings).choice(0.05, false);
  CHECK(choice.integrator == Integrator::implicit);
  CHECK_THAT(words(choice), Catch::Contains("layers"));
  settings.integrator = Integrator::leap_frog;
  CHECK_THROWS_WITH(AcousticSolver(mesh, settings), Catch::Contains("layers"));
}

TEST_CASE("a cell that closes ends the explicit integrator with a reason, and the automatic one goes on") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  std::vector<double> closed = mesh.coordinates;
  for (std::size_t v = 0; v < closed.size(); v += 2) closed[v] = std::max(closed[v], 0.125 * (1 - 1e-9));
  AcousticSolver stopped(mesh, unit_medium(0.05, Integrator::leap_frog));
  stopped.set_state(bump(mesh));
  const AdvanceReport report = stopped.advance(0.05, {mesh.coordinates, closed});
  CHECK_FALSE(report.converged);
  CHECK_THAT(report.reason, Catch::Contains("closes"));
  CHECK(stopped.state().p == bump(mesh).p);
  AcousticSolver goes_on(mesh, unit_medium(0.05, Integrator::automatic));
  goes_on.set_state(bump(mesh));
  CHECK(goes_on.advance(0.05, {mesh.coordinates, closed}).passes > 0);
}

TEST_CASE("a sub-step that fails is reported and leaves the state of the last good one") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 8);
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog}) {
    AcousticSettings settings = unit_medium(0.1, integrator);
    settings.boundaries = {{"left", AcousticBoundaryKind::flux}};
    AcousticSolver solver(mesh, settings);
    Source source;
    source.flux = [](double t) { return t < 0.35 ? 1.0 : std::numeric_limits<double>::quiet_NaN(); };
    double last = 0;
    int heard = 0;
    const AdvanceReport report = solver.advance(1, {}, source, [&](double t) {
      last = t;
      ++heard;
    });
    CHECK_FALSE(report.converged);
    CHECK_FALSE(report.reason.empty());
    CHECK(heard == 3);
    CHECK(solver.state().time == last);
    CHECK(last == Approx(0.3));
    CHECK(std::all_of(solver.state().p.begin(), solver.state().p.end(), [](double p) { return std::isfinite(p); }));
  }
}

}  // namespace vocalis::acoustic
