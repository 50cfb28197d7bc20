#include "fsi_solver/fsi_solver.hpp"

#include <cmath>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
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
mesh::Mesh soft_channel(int cells) {
  return box_of_regions({4e-3, 1.5e-3, 0}, {4 * cells, 3 * cells / 2, 0}, {"air", "floor"},
                        [](const std::array<double, 3>& x) { return x[1] < 0.5e-3 ? 1 : 0; });
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

}  // namespace vocalis::fsi
