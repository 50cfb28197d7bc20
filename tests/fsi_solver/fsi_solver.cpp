#include "fsi_solver/fsi_solver.hpp"

#include "core/base/error.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"
#include "tests/fsi_solver/measured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

/// A channel 4 x 1 mm with an elastic floor, blown from the left, symmetric at the top.
mesh::Mesh soft_channel(int cells, MPI_Comm comm = MPI_COMM_WORLD) {
  return box_of_regions(
      {4e-3, 1.5e-3, 0}, {4 * cells, 3 * cells / 2, 0}, {"air", "floor"},
      [](const std::array<double, 3>& x) { return x[1] < 0.5e-3 ? 1 : 0; }, comm);
}

FlowSettings soft_channel_settings() {
  FlowSettings settings;
  settings.boundaries = {boundary("left", FlowBoundaryKind::pressure, 40), boundary("right", FlowBoundaryKind::outlet),
                         boundary("top", FlowBoundaryKind::symmetry), boundary("bottom", FlowBoundaryKind::fixed)};
  settings.boundaries[0].ramp = 1e-3;
  SolidMaterial floor;
  floor.region = "floor";
  floor.young_modulus = 3000;
  floor.damping = 0.1;
  settings.solids = {floor};
  settings.newton_tolerance = 1e-11;
  settings.newton_iterations = 25;
  return settings;
}

/// One step of 0.1 ms.
void step_both(FsiSolver& one, FsiSolver& other) {
  for (FsiSolver* solver : {&one, &other}) {
    REQUIRE_ON_ALL_RANKS(solver->try_step(1e-4).converged);
    solver->accept();
  }
}

}  // namespace

TEST_CASE("a soft channel gives way to the pressure") {
  const mesh::Mesh mesh = soft_channel(8);
  FsiSolver solver(mesh, soft_channel_settings(), {.end = 1, .step = 1e-4});
  for (int step = 0; step < 10; ++step) {
    const StepReport report = solver.try_step(1e-4);
    INFO(report.reason << " residual " << report.residual);
    REQUIRE_ON_ALL_RANKS(report.converged);
    CHECK(report.smallest_quality > 0.5);
    solver.accept();
  }
  CHECK(solver.time() == Approx(1e-3));
  CHECK(largest(solver.state().displacement.values) > 1e-7);
  CHECK(flux(solver, "right") > 0);
  CHECK(flux(solver, "left") < 0);
}

TEST_CASE("a step that is rejected leaves no trace") {
  const mesh::Mesh mesh = soft_channel(8);
  FsiSolver one(mesh, soft_channel_settings(), {.end = 1, .step = 1e-4});
  FsiSolver other(mesh, soft_channel_settings(), {.end = 1, .step = 1e-4});
  for (int step = 0; step < 3; ++step) {
    if (step == 2) {
      const State before = one.state();
      REQUIRE_ON_ALL_RANKS(one.try_step(3e-4).converged);  // converges, but is not accepted
      CHECK(before.velocity.values == one.state().velocity.values);
      CHECK(before.displacement.values == one.state().displacement.values);
      CHECK(before.time == one.state().time);
      one.drop_caches();
      other.drop_caches();
    }
    step_both(one, other);
  }
  CHECK(one.state().velocity.values == other.state().velocity.values);
  CHECK(one.state().pressure.values == other.state().pressure.values);
}

TEST_CASE("a run that goes on from its state repeats the last digit") {
  const mesh::Mesh mesh = soft_channel(8);
  FsiSolver one(mesh, soft_channel_settings(), {.end = 1, .step = 1e-4});
  for (int step = 0; step < 3; ++step) {
    REQUIRE_ON_ALL_RANKS(one.try_step(1e-4).converged);
    one.accept();
  }
  FsiSolver other(mesh, soft_channel_settings(), {.end = 1, .step = 1e-4});
  other.set_state(one.state());
  one.drop_caches();
  for (int step = 0; step < 3; ++step) step_both(one, other);
  CHECK(one.state().velocity.values == other.state().velocity.values);
  CHECK(one.state().displacement.values == other.state().displacement.values);
  CHECK(one.state().pressure.values == other.state().pressure.values);
}

TEST_CASE("any number of ranks gives the same answer") {
  const mesh::Mesh shared = soft_channel(8), whole = soft_channel(8, MPI_COMM_SELF);
  FsiSolver together(shared, soft_channel_settings(), {.end = 1, .step = 1e-4});
  FsiSolver alone(whole, soft_channel_settings(), {.end = 1, .step = 1e-4});
  for (int step = 0; step < 5; ++step) step_both(together, alone);
  CHECK(flux(together, "right") == Approx(flux(alone, "right")).epsilon(1e-9));
  CHECK(flux(together, "left") == Approx(flux(alone, "left")).epsilon(1e-9));
  CHECK(smallest_quality(together) == Approx(smallest_quality(alone)).epsilon(1e-9));
  CHECK(largest(together.state().displacement.values) ==
        Approx(largest(alone.state().displacement.values)).epsilon(1e-9));
  CHECK(largest(together.fluid_pressure().values) == Approx(largest(alone.fluid_pressure().values)).epsilon(1e-9));
}

TEST_CASE("a step too far is rejected with a reason, not computed") {
  const mesh::Mesh mesh = soft_channel(8);
  FlowSettings settings = soft_channel_settings();
  settings.boundaries[0].pressure = 4e6;
  settings.boundaries[0].ramp = 0;
  FsiSolver solver(mesh, settings, {.end = 1, .step = 1e-4});
  const StepReport report = solver.try_step(1e-2);
  CHECK_FALSE(report.converged);
  CHECK_FALSE(report.reason.empty());
  CHECK(solver.time() == 0);
  CHECK(largest(solver.state().velocity.values) == 0);
}

TEST_CASE("what the mesh does not have is refused") {
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {3, 3, 0});
  FlowSettings settings;
  settings.solids.emplace_back().region = "fold";
  CHECK_THROWS_AS(FsiSolver(mesh, settings, {}), base::UserError);
  settings.solids.clear();
  settings.boundaries = {boundary("mouth", FlowBoundaryKind::outlet)};
  CHECK_THROWS_AS(FsiSolver(mesh, settings, {}), base::UserError);
}

}  // namespace vocalis::fsi
