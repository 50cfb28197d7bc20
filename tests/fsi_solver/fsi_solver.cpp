#include "fsi_solver/fsi_solver.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/facet_integrals.hpp"
#include "fsi_solver/continuum.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {

namespace {

using test::box_of;
using test::box_of_regions;

FlowBoundary boundary(const std::string& group, FlowBoundaryKind kind, double pressure = 0) {
  FlowBoundary result;
  result.group = group;
  result.kind = kind;
  result.pressure = pressure;
  return result;
}

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

double flux(const FsiSolver& solver, const std::string& group) {
  std::vector<double> points = solver.continuum().reference_points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += solver.state().displacement.values[i];
  return fem::flux_through(solver.state().velocity, points, fem::facets_seen_once(*solver.continuum().mesh, group));
}

double largest(const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return base::largest(MPI_COMM_WORLD, result);
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
    REQUIRE_ON_ALL_RANKS(one.try_step(1e-4).converged);
    REQUIRE_ON_ALL_RANKS(other.try_step(1e-4).converged);
    one.accept();
    other.accept();
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
  for (int step = 0; step < 3; ++step) {
    REQUIRE_ON_ALL_RANKS(one.try_step(1e-4).converged);
    REQUIRE_ON_ALL_RANKS(other.try_step(1e-4).converged);
    one.accept();
    other.accept();
  }
  CHECK(one.state().velocity.values == other.state().velocity.values);
  CHECK(one.state().displacement.values == other.state().displacement.values);
  CHECK(one.state().pressure.values == other.state().pressure.values);
}

TEST_CASE("any number of ranks gives the same answer") {
  const mesh::Mesh shared = soft_channel(8), whole = soft_channel(8, MPI_COMM_SELF);
  FsiSolver together(shared, soft_channel_settings(), {.end = 1, .step = 1e-4});
  FsiSolver alone(whole, soft_channel_settings(), {.end = 1, .step = 1e-4});
  for (int step = 0; step < 5; ++step) {
    REQUIRE_ON_ALL_RANKS(together.try_step(1e-4).converged);
    REQUIRE_ON_ALL_RANKS(alone.try_step(1e-4).converged);
    together.accept();
    alone.accept();
  }
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

TEST_CASE("a uniform flow stays uniform on a mesh that moves") {
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {6, 6, 0});
  for (const TimeScheme scheme : {TimeScheme::theta, TimeScheme::bdf2}) {
    FlowSettings settings;
    settings.newton_tolerance = 1e-11;
    for (const char* group : {"left", "right", "bottom", "top"}) {
      settings.boundaries.push_back(boundary(group, FlowBoundaryKind::velocity));
      settings.boundaries.back().velocity = {3, -2, 0};
    }
    Prescribed prescribed;
    prescribed.mesh_displacement = [](const std::array<double, 3>& x, double t) -> std::array<double, 3> {
      return {0.1 * std::sin(40 * t) * std::sin(3 * x[0]) * std::sin(4 * x[1]), 0.1 * std::sin(30 * t) * x[0] * x[1],
              0};
    };
    FsiSolver solver(mesh, settings, {.scheme = scheme}, prescribed);
    State start = solver.state();
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      start.velocity.at(v)[0] = start.velocity_before.at(v)[0] = 3;
      start.velocity.at(v)[1] = start.velocity_before.at(v)[1] = -2;
    }
    solver.set_state(start);
    for (int step = 0; step < 6; ++step) {
      REQUIRE_ON_ALL_RANKS(solver.try_step(step % 2 ? 0.02 : 0.03).converged);
      solver.accept();
    }
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      CHECK(solver.state().velocity.at(v)[0] == Approx(3).epsilon(1e-11));
      CHECK(solver.state().velocity.at(v)[1] == Approx(-2).epsilon(1e-11));
    }
    CHECK(largest(solver.state().pressure.values) < 1e-9);
  }
}

TEST_CASE("a free solid turns and flies without deforming") {
  const mesh::Mesh mesh = box_of("solid", {1, 1, 0}, {3, 3, 0});
  FlowSettings settings;
  SolidMaterial solid;
  solid.region = "solid";
  solid.density = 2;
  solid.young_modulus = 100;
  solid.damping = 1;
  settings.solids = {solid};
  settings.newton_tolerance = 1e-9;
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::theta, .theta = 0.5});
  State start = solver.state();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    start.velocity.at(v)[0] = 1;
    start.velocity.at(v)[1] = -4;
  }
  solver.set_state(start);
  for (int step = 0; step < 5; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(0.1).converged);
    solver.accept();
  }
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    CHECK(solver.state().displacement.at(v)[0] == Approx(0.5));
    CHECK(solver.state().displacement.at(v)[1] == Approx(-2));
  }
}

TEST_CASE("Poiseuille flow has the pressure gradient of its mean velocity") {
  // dp/dx = -12 µ mean / H²; the first and the last length H of the channel belong to its ends.
  const mesh::Mesh mesh = box_of("fluid", {4, 1, 0}, {32, 16, 0});
  FlowSettings settings;
  settings.density = 1;
  settings.viscosity = 1;
  settings.newton_tolerance = 1e-10;
  settings.boundaries = {boundary("left", FlowBoundaryKind::velocity), boundary("right", FlowBoundaryKind::outlet)};
  settings.boundaries[0].velocity = {1, 0, 0};
  settings.boundaries[0].profile = VelocityProfile::parabolic;
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::theta, .theta = 1});
  for (int step = 0; step < 4; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(10).converged);
    solver.accept();
  }
  CHECK(flux(solver, "left") == Approx(-1).epsilon(0.01));
  CHECK(flux(solver, "right") == Approx(1).epsilon(0.01));
  double drop = 0, middle = 0;
  for (std::int32_t dof = 0; dof < solver.pressure_space().dofs.num_owned; ++dof) {
    const std::int32_t vertex = solver.pressure_space().dof_vertex[dof];
    const double* x = mesh.point(vertex);
    if (std::abs(x[1] - 0.5) > 1e-9) continue;
    if (std::abs(x[0] - 1.5) < 1e-9) drop += solver.state().pressure.values[dof];
    if (std::abs(x[0] - 2.5) < 1e-9) drop -= solver.state().pressure.values[dof];
    if (std::abs(x[0] - 2) < 1e-9) middle += solver.state().velocity.at(vertex)[0];
  }
  CHECK(base::sum(MPI_COMM_WORLD, drop) == Approx(12).epsilon(0.01));
  CHECK(base::sum(MPI_COMM_WORLD, middle) == Approx(1.5).epsilon(0.01));
}

TEST_CASE("an incompressible block under a lasting load comes to rest and keeps its volume") {
  const mesh::Mesh mesh = box_of("solid", {1, 1, 0}, {6, 6, 0});
  FlowSettings settings;
  SolidMaterial solid;
  solid.region = "solid";
  solid.density = 1;
  solid.young_modulus = 30;
  solid.incompressible = true;
  solid.damping = 3;
  settings.solids = {solid};
  settings.boundaries = {boundary("bottom", FlowBoundaryKind::fixed), boundary("top", FlowBoundaryKind::pressure, 5)};
  settings.newton_tolerance = 1e-9;
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2});
  double volume = 0;
  for (int step = 0; step < 120; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(0.1).converged);
    solver.accept();
  }
  CHECK(largest(solver.state().velocity.values) < 1e-6);
  const std::vector<double> x = solver.current_coordinates();
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto v = mesh.vertices_of(cell);
    const auto at = [&](int a, int k) { return x[2 * v[a] + k] - x[2 * v[0] + k]; };
    volume += 0.5 * (at(1, 0) * at(2, 1) - at(1, 1) * at(2, 0));
  }
  CHECK(base::sum(MPI_COMM_WORLD, volume) == Approx(1).epsilon(2e-3));
  CHECK(largest(solver.state().displacement.values) > 0.02);
}

TEST_CASE("a soft block in a duct moves with the air in three dimensions") {
  const mesh::Mesh mesh = box_of_regions(
      {2e-3, 1e-3, 1e-3}, {6, 4, 3}, {"air", "block"},
      [](const std::array<double, 3>& x) { return x[1] < 0.5e-3 && x[0] > 0.6e-3 && x[0] < 1.4e-3 ? 1 : 0; });
  FlowSettings settings;
  settings.boundaries = {
      boundary("left", FlowBoundaryKind::pressure, 20), boundary("right", FlowBoundaryKind::outlet),
      boundary("top", FlowBoundaryKind::symmetry),      boundary("front", FlowBoundaryKind::symmetry),
      boundary("back", FlowBoundaryKind::symmetry),     boundary("bottom", FlowBoundaryKind::fixed)};
  SolidMaterial block;
  block.region = "block";
  block.young_modulus = 2000;
  settings.solids = {block};
  FsiSolver solver(mesh, settings, {.end = 1, .step = 1e-4});
  for (int step = 0; step < 3; ++step) {
    const StepReport report = solver.try_step(5e-5);
    INFO(report.reason << " " << report.residual);
    REQUIRE_ON_ALL_RANKS(report.converged);
    CHECK(report.newton_iterations <= 8);
    solver.accept();
  }
  CHECK(flux(solver, "right") > 0);
  CHECK(largest(solver.state().displacement.values) > 1e-8);
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
