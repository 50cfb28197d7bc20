// A block of tissue falls on another through a layer of fluid: as contact cells the layer carries it, and lets go.
#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {
namespace {

mesh::Mesh blocks() {
  return test::box_of_regions({0.01, 0.01, 0}, {6, 10, 0}, {"low", "gap", "high"}, [](const auto& x) {
    return x[1] < 0.004 ? 0 : x[1] < 0.006 ? 1 : 2;
  });
}

FlowSettings settings(Elements elements) {
  FlowSettings flow;
  flow.elements = elements;
  flow.density = 1;
  flow.viscosity = 1e-3;
  flow.gravity = {0, -20, 0};
  for (const char* region : {"low", "high"}) {
    SolidMaterial tissue;
    tissue.region = region;
    tissue.young_modulus = 2000;
    tissue.density = 1000;
    tissue.damping = 2;
    flow.solids.push_back(tissue);
  }
  flow.boundaries = {{.group = "bottom", .kind = FlowBoundaryKind::fixed},
                     {.group = "left", .kind = FlowBoundaryKind::outlet},
                     {.group = "right", .kind = FlowBoundaryKind::outlet}};
  flow.contact = ContactMedium{.young_modulus = 2000, .damping = 2};
  flow.mesh_recovery = 0.01;
  return flow;
}

std::vector<char> cells_of(const FsiSolver& solver, bool wanted) {
  std::vector<char> marks(solver.continuum().mesh->num_cells());
  for (std::size_t cell = 0; cell < marks.size(); ++cell) {
    marks[cell] = wanted && solver.continuum().mesh->cell_region[cell] == 1;
  }
  return marks;
}

/// Mean speed of the upper block and the height of its top [m].
double height(const FsiSolver& solver) {
  const std::vector<double> places = solver.current_coordinates();
  double lowest = 1;
  for (std::int32_t v = 0; v < solver.continuum().mesh->num_vertices(); ++v) {
    if (solver.continuum().mesh->point(v)[1] > 0.0099) lowest = std::min(lowest, places[2 * v + 1]);
  }
  return base::smallest(solver.continuum().mesh->comm, lowest);
}

int steps_until_failure(FsiSolver& solver, double dt, int steps) {
  for (int step = 0; step < steps; ++step) {
    const StepReport report = solver.try_step(dt);
    UNSCOPED_INFO(step << " " << report.newton_iterations << " " << report.reason);
    if (!report.converged) return step;
    solver.accept();
  }
  return steps;
}

TEST_CASE("Contact cells carry a block that without them runs the mesh down") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = blocks();
    const TimeSettings time{.end = 1, .step = 5e-4};
    FsiSolver alone(mesh, settings(elements), time);
    CHECK(steps_until_failure(alone, 5e-4, 200) < 200);

    FsiSolver solver(mesh, settings(elements), time);
    solver.set_contact(cells_of(solver, true));
    REQUIRE(steps_until_failure(solver, 5e-4, 200) == 200);
    const double rest = height(solver);
    REQUIRE(steps_until_failure(solver, 5e-4, 20) == 20);
    INFO("height " << rest);
    CHECK(rest > 0.007);
    CHECK(std::abs(height(solver) - rest) < 1e-5);
  }
}

}  // namespace
}  // namespace vocalis::fsi
