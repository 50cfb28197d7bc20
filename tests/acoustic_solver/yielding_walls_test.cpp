#include <algorithm>
#include <cmath>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/wall_branches.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

AcousticBoundary yielding(const std::string& group, double mass, double resistance, double stiffness) {
  AcousticBoundary boundary{group, AcousticBoundaryKind::yielding};
  boundary.mass = mass;
  boundary.resistance = resistance;
  boundary.stiffness = stiffness;
  return boundary;
}

/// Strong enough to be felt in the unit medium.
AcousticBoundary viscothermal(const std::string& group) {
  AcousticBoundary boundary{group, AcousticBoundaryKind::viscothermal};
  boundary.kinematic_viscosity = boundary.thermal_diffusivity = 0.1;
  return boundary;
}

AcousticSettings unit_medium(std::vector<AcousticBoundary> boundaries) {
  AcousticSettings settings = test::unit_medium(0.03);
  settings.boundaries = std::move(boundaries);
  return settings;
}

mesh::Mesh unit_box(MPI_Comm comm, int dimension) { return test::unit_box(comm, dimension, 12); }

/// A bump of pressure off the middle; walls at rest.
State bump(const mesh::Mesh& mesh) {
  State state;
  state.psi.assign(mesh.num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    state.p.push_back(std::exp(-std::pow((mesh.point(v)[0] - 0.3) / 0.2, 2) - std::pow(mesh.point(v)[1] / 0.3, 2)));
  }
  return state;
}

double largest_difference(const mesh::Mesh& mesh, const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t v = 0; v < a.size(); ++v) largest = std::max(largest, std::abs(a[v] - b[v]));
  return base::largest(mesh.comm, largest);
}

void throws(const AcousticBoundary& boundary, const std::string& words) {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2);
  std::string said;
  try {
    const AcousticSolver solver(mesh, unit_medium({boundary}));
  } catch (const base::UserError& error) {
    said = error.what();
  }
  CHECK_THAT(said, Catch::Contains(words));
}

}  // namespace

TEST_CASE("branches of a boundary layer have the square root of the frequency as their admittance", "[serial]") {
  const auto branches = square_root_branches(3.0);
  double largest = 0;
  for (double f = 50; f <= 10000; f *= 1.01) {
    const std::complex<double> rate(0, 2 * std::numbers::pi * f);
    largest = std::max(largest, std::abs(wall_admittance(branches, rate) / (3.0 * std::sqrt(rate)) - 1.0));
  }
  CHECK(largest < 0.007);
  for (const WallBranch& branch : branches) {
    CHECK((branch.mass >= 0 && branch.resistance >= 0 && branch.stiffness >= 0));
  }
}

TEST_CASE("walls that yield keep the energy or take it, whatever the step") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, dimension);
    for (const double step : {0.03, 0.4}) {
      const auto change = [&](std::vector<AcousticBoundary> walls) {
        AcousticSettings settings = unit_medium(std::move(walls));
        settings.step = step;
        AcousticSolver solver(mesh, settings);
        solver.set_state(bump(mesh));
        const double start = solver.energy();
        double largest_growth = 0;
        double before = start;
        for (int n = 0; n < 150; ++n) {
          REQUIRE_ON_ALL_RANKS(solver.advance(step).converged);
          largest_growth = std::max(largest_growth, solver.energy() / before - 1);
          before = solver.energy();
        }
        CHECK(largest_growth < 1e-9);
        return before / start - 1;
      };
      CHECK(std::abs(change({yielding("right", 0.5, 0, 30), yielding("bottom", 2, 0, 0)})) < 1e-8);
      CHECK(change({yielding("right", 0.5, 1, 30), yielding("bottom", 2, 0, 0)}) < -0.1);
      CHECK(change({viscothermal("bottom"), viscothermal("left")}) < -0.1);
    }
  }
}

TEST_CASE("what walls yield does not depend on the number of ranks") {
  for (const int dimension : {2, 3}) {
    const auto run = [&](MPI_Comm comm) {
      const mesh::Mesh mesh = unit_box(comm, dimension);
      AcousticSolver solver(mesh, unit_medium({yielding("right", 0.5, 0.2, 30), viscothermal("bottom")}));
      solver.set_state(bump(mesh));
      std::vector<double> heard;
      const auto listen = [&](double) {
        double sum = 0;
        for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) sum += solver.state().p[v] * mesh.point(v)[0];
        heard.push_back(base::sum(comm, sum));
      };
      REQUIRE_ON_ALL_RANKS(solver.advance(2, {}, {}, listen).converged);
      return heard;
    };
    const auto alone = run(MPI_COMM_SELF), together = run(MPI_COMM_WORLD);
    REQUIRE_ON_ALL_RANKS(alone.size() == together.size());
    for (std::size_t i = 0; i < alone.size(); ++i) CHECK(std::abs(alone[i] - together[i]) < 1e-8);
  }
}

TEST_CASE("a state with the motion of its walls goes on exactly, and one without it does not") {
  const AcousticSettings settings = unit_medium({yielding("right", 0.5, 0.2, 30), viscothermal("bottom")});
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 3);
  AcousticSolver solver(mesh, settings);
  solver.set_state(bump(mesh));
  CHECK(solver.advance(1).converged);
  const State state = solver.state();
  State at_rest = state;
  at_rest.wall_motion.clear();
  const auto end_of = [&](State from) {
    AcousticSolver other(mesh, settings);
    other.set_state(std::move(from));
    CHECK(other.advance(0.6).converged);
    return other.state().p;
  };
  solver.drop_caches();
  CHECK(solver.advance(0.6).converged);
  CHECK(largest_difference(mesh, end_of(state), solver.state().p) == 0);
  CHECK(largest_difference(mesh, end_of(at_rest), solver.state().p) > 0.01);
}

TEST_CASE("a wall of resistance alone is one of admittance, also where it swings") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2);
  const auto end_with = [&](const AcousticBoundary& wall) {
    AcousticSolver solver(mesh, unit_medium({wall}));
    solver.set_state(bump(mesh));
    std::vector<double> before = mesh.coordinates;
    for (int n = 1; n <= 30; ++n) {
      std::vector<double> after = mesh.coordinates;
      for (std::size_t i = 0; i < after.size(); i += 2) after[i] *= 1 + 0.1 * std::sin(0.1 * n);
      CHECK(solver.advance(0.03, {before, after}).converged);
      before = after;
    }
    return solver.state().p;
  };
  AcousticBoundary admitting{"right", AcousticBoundaryKind::admittance, 0.4};
  const auto expected = end_with(admitting);
  CHECK(largest_difference(mesh, end_with(yielding("right", 1e-12, 2 * 1 / 0.4, 0)), expected) < 1e-7);
  CHECK(largest_difference(mesh, end_with(yielding("right", 1, 2 * 1 / 0.4, 0)), expected) > 0.01);
}

TEST_CASE("walls of numbers that make no sense are the user's mistake") {
  throws(yielding("right", 0, 1, 1), "mass of the wall 'right' is positive");
  throws(yielding("right", 1, -1, 1), "resistance of the wall 'right' is not negative");
  throws(yielding("right", 1, 1, -1), "stiffness");
  throws(yielding("right", std::nan(""), 1, 1), "mass");
  AcousticBoundary layer = viscothermal("bottom");
  layer.kinematic_viscosity = 0;
  throws(layer, "kinematic_viscosity");
  layer = viscothermal("bottom");
  layer.heat_capacity_ratio = 0.9;
  throws(layer, "heat_capacity_ratio");
}

TEST_CASE("walls that yield keep to the implicit integrator") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2);
  for (const AcousticBoundary& wall : {yielding("right", 1, 1, 1), viscothermal("right")}) {
    AcousticSettings settings = unit_medium({wall});
    settings.integrator = Integrator::automatic;
    CHECK(AcousticSolver(mesh, settings).choice(0.01, false).integrator == Integrator::implicit);
    settings.boundaries.clear();
    CHECK(AcousticSolver(mesh, settings).choice(0.01, false).integrator == Integrator::leap_frog);
    settings.boundaries = {wall};
    settings.integrator = Integrator::leap_frog;
    CHECK_THROWS_AS(AcousticSolver(mesh, settings), base::UserError);
  }
}

}  // namespace vocalis::acoustic
