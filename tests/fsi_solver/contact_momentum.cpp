// Two free blocks meet through closed contact cells: what one gains the other loses.
#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "fsi_solver/measures/energy.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/contact_blocks.hpp"

namespace vocalis::fsi {
namespace {

/// ∫ ρ v over all cells where they were when they closed, which is the reference here [kg m/s a metre of depth].
std::array<double, 2> momentum(const FsiSolver& solver) {
  const Continuum& continuum = solver.continuum();
  const fem::Space& space = continuum.velocity_space;
  std::array<double, 2> sum = {0, 0};
  for (std::int32_t cell = 0; cell < continuum.mesh->num_cells(); ++cell) {
    const double weight = continuum.solids[continuum.cell_solid[cell]].density *
                          mesh::signed_volume(*continuum.mesh, continuum.mesh->vertices_of(cell)) / 3;
    // Linear: the mean of the corners; quadratic: that of the middles.
    for (int a = space.degree == 1 ? 0 : 3; a < space.dofs_per_cell; ++a) {
      for (int k = 0; k < 2; ++k) sum[k] += weight * solver.state().velocity.at(space.dofs_of(cell)[a])[k];
    }
  }
  for (double& part : sum) part = base::sum(continuum.mesh->comm, part);
  return sum;
}

}  // namespace

TEST_CASE("A closed contact conserves momentum to rounding, and makes no energy") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = test::blocks();
    FsiSolver solver(mesh, test::free_blocks(elements), {.end = 1, .step = 2e-4});
    solver.set_contact(test::cells_between(solver));
    test::start(solver, 0.05);
    const std::array<double, 2> before = momentum(solver);
    const double size = std::hypot(before[0], before[1]);
    const OpenFacets open = find_open_facets(solver);
    double first = 0, slowest = 1, largest_drift = 0;
    for (int step = 0; step < 60; ++step) {
      const StepReport report = solver.try_step(2e-4);
      INFO("step " << step << " " << report.reason);
      REQUIRE_ON_ALL_RANKS(report.converged);
      solver.accept();
      const std::array<double, 2> now = momentum(solver);
      largest_drift = std::max(largest_drift, std::hypot(now[0] - before[0], now[1] - before[1]) / size);
      const EnergyRates rates = energy(solver, open);
      if (step == 0) first = rates.kinetic + rates.elastic;
      CHECK(rates.kinetic + rates.elastic < first * (1 + 1e-9));
      slowest = std::min(slowest, rates.kinetic / first);
    }
    INFO("drift " << largest_drift << " least kinetic energy " << slowest);
    CHECK(largest_drift < 1e-10);
    CHECK(slowest < 0.8);  // they did push each other
  }
}

}  // namespace vocalis::fsi
