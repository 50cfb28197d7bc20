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

/// No gravity and no wall: zero tractions all around.
FlowSettings free_blocks(Elements elements) {
  FlowSettings flow;
  flow.elements = elements;
  flow.density = 1;
  flow.viscosity = 1e-3;
  flow.newton_tolerance = 1e-12;
  for (const char* region : {"low", "high"}) {
    SolidMaterial tissue;
    tissue.region = region;
    tissue.young_modulus = 2000;
    tissue.density = 1000;
    flow.solids.push_back(tissue);
  }
  for (const char* group : {"left", "right"}) {
    flow.boundaries.emplace_back().group = group;
    flow.boundaries.back().kind = FlowBoundaryKind::pressure;
  }
  flow.contact = ContactMedium{.young_modulus = 2000};
  return flow;
}

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

/// The upper block comes down on the lower one, and a little sideways.
void start(FsiSolver& solver, double speed) {
  State state = solver.state();
  for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
    if (solver.continuum().reference_points[2 * static_cast<std::size_t>(dof) + 1] < 0.0059) continue;
    state.velocity.at(dof)[0] = 0.3 * speed;
    state.velocity.at(dof)[1] = -speed;
  }
  state.velocity_before = state.velocity;
  solver.set_state(state);
}

}  // namespace

TEST_CASE("A closed contact conserves momentum to rounding, and makes no energy") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = test::blocks();
    FsiSolver solver(mesh, free_blocks(elements), {.end = 1, .step = 2e-4});
    solver.set_contact(test::cells_between(solver));
    start(solver, 0.05);
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

TEST_CASE("A contact with air beside it makes no energy") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const mesh::Mesh mesh = test::blocks();
    FlowSettings flow = free_blocks(elements);
    for (FlowBoundary& boundary : flow.boundaries) boundary.kind = FlowBoundaryKind::outlet;
    const double dt = 5e-5;
    FsiSolver solver(mesh, flow, {.end = 1, .step = dt});
    std::vector<char> closed(mesh.num_cells());
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      double middle = 0;
      for (const std::int32_t v : mesh.vertices_of(cell)) middle += mesh.point(v)[0] / 3;
      closed[cell] = mesh.cell_region[cell] == 1 && std::abs(middle - 0.005) < 0.003;
    }
    solver.set_contact(closed);
    start(solver, 0.05);
    const OpenFacets open = find_open_facets(solver);
    EnergyRates before;
    double first = 0, work = 0, gain = 0;
    for (int step = 0; step < 200; ++step) {
      const StepReport report = solver.try_step(dt);
      INFO("step " << step << " " << report.reason);
      REQUIRE_ON_ALL_RANKS(report.converged);
      solver.accept();
      const EnergyRates rates = energy(solver, open);
      if (step == 0) first = rates.kinetic + rates.elastic;
      if (step > 0) work += 0.5 * dt * (rates.supplied - rates.dissipated + before.supplied - before.dissipated);
      before = rates;
      gain = std::max(gain, (rates.kinetic + rates.elastic - first - work) / first);
    }
    INFO("gain " << gain);
    CHECK(gain < 0.01);
  }
}

}  // namespace vocalis::fsi
