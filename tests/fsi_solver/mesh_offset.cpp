// The offset of the mesh that is left where cells have opened: it goes as exp(-t / mesh_recovery), and faster where it
// would turn a cell over.
#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/contact_blocks.hpp"

namespace vocalis::fsi {
namespace {

double largest_offset(const FsiSolver& solver) {
  double largest = 0;
  for (const double value : solver.state().mesh_offset) largest = std::max(largest, std::abs(value));
  return base::largest(solver.continuum().mesh->comm, largest);
}

/// Middle of the layer up by `offset` [m]; it is 1 mm from the blocks. What is left of the offset after a step of 0.5
/// ms.
double left_after_a_step(double offset) {
  const mesh::Mesh mesh = test::blocks();
  FsiSolver solver(mesh, test::block_settings(Elements::p2p1), {.end = 1, .step = 5e-4});
  State state = solver.state();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    if (std::abs(mesh.point(v)[1] - 0.005) < 1e-9) state.mesh_offset[2 * v + 1] = offset;
  }
  solver.set_state(state);
  const StepReport report = solver.try_step(5e-4);
  INFO(report.reason);
  REQUIRE(report.converged);
  CHECK(report.smallest_quality > 0);
  solver.accept();
  return largest_offset(solver);
}

TEST_CASE("The mesh comes back from where cells opened, at once where it would be inverted") {
  CHECK(left_after_a_step(2e-4) == Approx(2e-4 * std::exp(-0.05)));
  const double left = left_after_a_step(2e-3);
  CHECK(left > 0);
  CHECK(left < 1e-3);
  CHECK(left_after_a_step(1) == 0);
}

}  // namespace
}  // namespace vocalis::fsi
