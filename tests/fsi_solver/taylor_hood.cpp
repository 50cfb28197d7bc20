#include <cmath>

#include "core/base/mpi.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/fsi_solver.hpp"
#include "fsi_solver/measures/body.hpp"
#include "fsi_solver/measures/energy.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

/// The largest difference of a velocity from a function of the place.
template <class Function>
double velocity_error(const FsiSolver& solver, const Function& exact) {
  const std::vector<double>& points = solver.continuum().reference_points;
  const int d = solver.continuum().mesh->dimension;
  double worst = 0;
  for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
    const std::array<double, 3> right = exact(points.data() + static_cast<std::size_t>(dof) * d);
    for (int k = 0; k < d; ++k) worst = std::max(worst, std::abs(solver.state().velocity.at(dof)[k] - right[k]));
  }
  return base::largest(MPI_COMM_WORLD, worst);
}

}  // namespace

TEST_CASE("a uniform flow in quadratic elements stays uniform on a curved mesh that moves") {
  for (const int d : {2, 3}) {
    const mesh::Mesh mesh = d == 2 ? box_of("fluid", {1, 1, 0}, {4, 4, 0}) : box_of("fluid", {1, 1, 1}, {2, 2, 2});
    FlowSettings settings;
    settings.elements = Elements::p2p1;
    settings.newton_tolerance = 1e-10;
    for (const std::string& group : mesh.group_names) {
      settings.boundaries.push_back(boundary(group, FlowBoundaryKind::velocity));
      settings.boundaries.back().velocity = {3, -2, d == 2 ? 0.0 : 1.0};
    }
    Prescribed prescribed;
    prescribed.mesh_displacement = [](const std::array<double, 3>& x, double t) -> std::array<double, 3> {
      return {0.05 * std::sin(40 * t) * std::sin(3 * x[0]) * std::sin(4 * x[1]),
              0.05 * std::sin(30 * t) * x[0] * x[1] * (1 + x[2]), 0};
    };
    FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2}, prescribed);
    State start = solver.state();
    for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
      for (int k = 0; k < d; ++k) {
        start.velocity.at(dof)[k] = start.velocity_before.at(dof)[k] = settings.boundaries[0].velocity[k];
      }
    }
    solver.set_state(start);
    for (int step = 0; step < 4; ++step) {
      REQUIRE_ON_ALL_RANKS(solver.try_step(step % 2 ? 0.02 : 0.03).converged);
      solver.accept();
    }
    CHECK(velocity_error(solver, [&](const double*) { return settings.boundaries[0].velocity; }) < 1e-9);
  }
}

TEST_CASE("quadratic elements hold Poiseuille flow exactly, out of the channel's end; force and energy balance") {
  const mesh::Mesh mesh = box_of("fluid", {3, 1, 0}, {6, 4, 0});
  FlowSettings settings;
  settings.elements = Elements::p2p1;
  settings.density = 1;
  settings.viscosity = 0.5;
  settings.newton_tolerance = 1e-12;
  settings.boundaries = {boundary("left", FlowBoundaryKind::velocity), boundary("right", FlowBoundaryKind::outlet)};
  settings.boundaries[0].velocity = {2, 0, 0};
  settings.boundaries[0].profile = VelocityProfile::parabolic;
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::theta, .theta = 1});
  for (int step = 0; step < 12; ++step) {
    REQUIRE_ON_ALL_RANKS(solver.try_step(1e3).converged);
    solver.accept();
  }
  CHECK(velocity_error(solver, [](const double* x) -> std::array<double, 3> {
          return {12 * x[1] * (1 - x[1]), 0, 0};
        }) < 1e-8);
  // dp/dx = -12 µ mean / H², which the two walls take up, but for what the inlet does to their first functions: each
  // has a sixth of an edge there.
  const double drop = 12 * 0.5 * 2 * 3;
  const std::array<double, 3> force = force_on(solver, make_body(solver, {"top", "bottom"}));
  CHECK(force[0] == Approx(drop * (1 - 2 * 0.25 / 6)).epsilon(1e-6));
  const EnergyRates rates = energy(solver, find_open_facets(solver));
  CHECK(rates.dissipated == Approx(drop * 2).epsilon(1e-8));
  CHECK(rates.supplied == Approx(drop * 2).epsilon(1e-8));
  CHECK(rates.kinetic == Approx(0.5 * 3 * 144.0 / 30).epsilon(1e-8));  // ∫ (y (1 - y))² dy = 1/30
}

namespace {

/// A channel with an elastic floor, pushed for a while and left alone: what its energy balance leaves at the end,
/// relative to what was supplied.
double energy_left(double dt, MPI_Comm comm, std::vector<double>& swing) {
  const mesh::Mesh mesh = box_of_regions(
      {4, 1.5, 0}, {16, 6, 0}, {"air", "floor"}, [](const std::array<double, 3>& x) { return x[1] < 0.5 ? 1 : 0; },
      comm);
  FlowSettings settings;
  settings.elements = Elements::p2p1;
  settings.streamline_stabilisation = false;
  settings.density = 1;
  settings.viscosity = 0.05;
  settings.newton_tolerance = 1e-10;
  settings.newton_iterations = 30;
  settings.boundaries = {boundary("left", FlowBoundaryKind::pressure), boundary("right", FlowBoundaryKind::outlet),
                         boundary("top", FlowBoundaryKind::symmetry), boundary("bottom", FlowBoundaryKind::fixed)};
  settings.boundaries[0].pressure = 20;
  settings.boundaries[0].ramp = 0.4;
  SolidMaterial floor;
  floor.region = "floor";
  floor.density = 1;
  floor.young_modulus = 200;
  floor.damping = 0.1;
  settings.solids = {floor};
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2});
  const OpenFacets open = find_open_facets(solver);
  double supplied = 0, dissipated = 0;
  EnergyRates last;
  for (int step = 0; step * dt < 0.4 - 1e-9; ++step) {
    const bool converged = solver.try_step(dt).converged;
    if (!converged) return NAN;
    solver.accept();
    const EnergyRates now = energy(solver, open);
    supplied += 0.5 * dt * (last.supplied + now.supplied);
    dissipated += 0.5 * dt * (last.dissipated + now.dissipated);
    last = now;
  }
  swing = {base::largest(comm, *std::max_element(solver.state().displacement.values.begin(),
                                                 solver.state().displacement.values.end())),
           last.kinetic, last.elastic, supplied};
  return std::abs(last.kinetic + last.elastic - supplied + dissipated) / supplied;
}

}  // namespace

TEST_CASE("what the balance of energy leaves falls with the square of the step, and all ranks agree") {
  std::vector<double> coarse_swing, fine_swing, alone;
  const double coarse = energy_left(0.02, MPI_COMM_WORLD, coarse_swing);
  const double fine = energy_left(0.01, MPI_COMM_WORLD, fine_swing);
  INFO("left " << coarse << " and " << fine);
  CHECK(fine < 0.01);
  CHECK(std::log2(coarse / fine) > 1.7);
  energy_left(0.02, MPI_COMM_SELF, alone);
  for (std::size_t i = 0; i < alone.size(); ++i) CHECK(coarse_swing[i] == Approx(alone[i]).epsilon(1e-7));
}

}  // namespace vocalis::fsi
