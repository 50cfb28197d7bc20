// Flows and solids whose motion is known, in linear elements.
#include <cmath>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"
#include "tests/fsi_solver/measured.hpp"

namespace vocalis::fsi {

using namespace test;

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

}  // namespace vocalis::fsi
