// A block of tissue falls on another through a layer of fluid: as contact cells the layer carries it, and lets go.
#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/contact_blocks.hpp"

namespace vocalis::fsi {
namespace {

/// Of the top of the upper block [m].
double height(const FsiSolver& solver) {
  const std::vector<double> places = solver.current_coordinates();
  double lowest = 1;
  for (std::int32_t v = 0; v < solver.continuum().mesh->num_vertices(); ++v) {
    if (solver.continuum().mesh->point(v)[1] > 0.0099) lowest = std::min(lowest, places[2 * v + 1]);
  }
  return base::smallest(solver.continuum().mesh->comm, lowest);
}

TEST_CASE("Contact cells carry a block that without them runs the mesh down") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = test::blocks();
    const TimeSettings time{.end = 1, .step = 5e-4};
    FsiSolver alone(mesh, test::block_settings(elements), time);
    CHECK(test::steps_until_failure(alone, 5e-4, 200) < 200);

    FsiSolver solver(mesh, test::block_settings(elements), time);
    solver.set_contact(test::cells_between(solver));
    REQUIRE(test::steps_until_failure(solver, 5e-4, 200) == 200);
    const double rest = height(solver);
    REQUIRE(test::steps_until_failure(solver, 5e-4, 20) == 20);
    INFO("height " << rest);
    CHECK(rest > 0.007);
    CHECK(std::abs(height(solver) - rest) < 1e-5);
  }
}

}  // namespace
}  // namespace vocalis::fsi
