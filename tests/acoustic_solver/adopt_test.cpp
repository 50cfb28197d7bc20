// Going on with another strip of the same parent: what is carried, and how air that has opened begins.
#include <algorithm>
#include <cmath>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/pockets.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

AcousticSettings unit_medium() { return test::unit_medium(0.03); }

mesh::Mesh box(int dimension) {
  return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {2, 0.3, dimension == 3 ? 0.2 : 0.0}, {40, 6, 4}));
}

/// The parent without the cells whose centre lies between two x.
transfer::StrippedMesh without(const mesh::Mesh& parent, double low, double high) {
  std::vector<std::int32_t> keep;
  for (std::int32_t cell = 0; cell < parent.num_cells(); ++cell) {
    double x = 0;
    for (const std::int32_t v : parent.vertices_of(cell)) x += parent.point(v)[0] / (parent.dimension + 1);
    keep.push_back(x < low || x > high);
  }
  return transfer::strip(parent, keep);
}

/// p and psi by formulas of x.
State state_of(const mesh::Mesh& mesh, double (*p)(double), double (*psi)(double)) {
  State state;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    state.p.push_back(p(mesh.point(v)[0]));
    state.psi.push_back(psi(mesh.point(v)[0]));
  }
  return state;
}

double nothing(double) { return 0; }
/// Silence from 0.9 on, to the last bit.
double bump(double x) { return x < 0.9 ? std::exp(-std::pow((x - 0.4) / 0.15, 2)) : 0; }

double largest_pressure(const AcousticSolver& solver, const mesh::Mesh& mesh, double from) {
  double largest = 0;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    if (mesh.point(v)[0] > from) largest = std::max(largest, std::abs(solver.state().p[v]));
  }
  return base::largest(mesh.comm, largest);
}

}  // namespace

TEST_CASE("pockets are what has no vertex in common, on any ranks") {
  const mesh::Mesh parent = box(2);
  const auto names_in = [&](const mesh::Mesh& mesh) {
    std::vector<std::int32_t> all = base::concatenate_all(mesh.comm, find_pockets(mesh));
    std::sort(all.begin(), all.end());
    return std::unique(all.begin(), all.end()) - all.begin();
  };
  CHECK(names_in(parent) == 1);
  CHECK(names_in(without(parent, 0.95, 1.15).mesh) == 2);
  CHECK(names_in(without(parent, 0, 3).mesh) == 0);
}

TEST_CASE("a pulse is not heard behind stripped cells, and is when they have opened") {
  for (const Integrator integrator : {Integrator::implicit, Integrator::leap_frog, Integrator::automatic}) {
    const mesh::Mesh parent = box(2);
    const auto open = without(parent, 9, 9), closed = without(parent, 0.95, 1.15);
    AcousticSettings settings = unit_medium();
    settings.integrator = integrator;
    AcousticSolver solver(open.mesh, settings);
    solver.set_state(state_of(open.mesh, bump, nothing));
    const double energy = solver.energy();
    const Adoption closing = solver.adopt(parent, open, closed);
    CHECK(closing.energy_before == energy);
    CHECK(closing.energy_after == Approx(energy).epsilon(1e-5));  // silence was stripped
    CHECK(solver.advance(1.5).converged);
    CHECK(largest_pressure(solver, closed.mesh, 1.14) == 0);
    CHECK(solver.energy() == Approx(energy).epsilon(0.01));  // of the explicit one swings by (ω dt)² / 8
    const Adoption opening = solver.adopt(parent, closed, open);
    CHECK(solver.energy() == opening.energy_after);
    CHECK(solver.advance(1.5).converged);
    CHECK(largest_pressure(solver, open.mesh, 1.14) > 0.2);
    CHECK(solver.energy() == Approx(opening.energy_after).epsilon(0.03));
  }
}

TEST_CASE("potentials that drifted apart while closed are no velocity in the opened gap") {
  // Two pockets at rest, each with a potential of its own: they are at rest after opening, too.
  for (const int d : {2, 3}) {
    const mesh::Mesh parent = box(d);
    const auto open = without(parent, 9, 9), closed = without(parent, 0.85, 1.15);
    const auto two_levels = [](double x) { return x < 1 ? -7.0 : 5.0; };
    AcousticSolver solver(closed.mesh, unit_medium());
    solver.set_state(state_of(closed.mesh, nothing, two_levels));
    const Adoption opening = solver.adopt(parent, closed, open);
    CHECK(opening.energy_before < 1e-20);
    CHECK(opening.energy_after < 1e-20);
    // The larger one is on the left where the left is longer: it keeps its potential.
    const auto longer_left = without(parent, 1.35, 1.55);
    AcousticSolver other(longer_left.mesh, unit_medium());
    other.set_state(state_of(longer_left.mesh, nothing, [](double x) { return x < 1.4 ? -7.0 : 5.0; }));
    other.adopt(parent, longer_left, open);
    double farthest = 0;
    for (const double psi : other.state().psi) farthest = std::max(farthest, std::abs(psi + 7));
    CHECK(base::largest(parent.comm, farthest) < 1e-12);
  }
}

TEST_CASE("a pocket with an open sphere keeps its potential; two such keep the velocity between them") {
  const mesh::Mesh parent = box(2);
  const auto open = without(parent, 9, 9), closed = without(parent, 1.35, 1.55);
  AcousticSettings settings = unit_medium();
  settings.boundaries = {{.group = "right", .kind = AcousticBoundaryKind::open, .radius = 1}};
  const auto level = [](double x) { return x < 1.45 ? -7.0 : 5.0; };
  const auto farthest_from = [&](const AcousticSolver& solver, double value) {
    double farthest = 0;
    for (const double psi : solver.state().psi) farthest = std::max(farthest, std::abs(psi - value));
    return base::largest(parent.comm, farthest);
  };
  AcousticSolver solver(closed.mesh, settings);
  solver.set_state(state_of(closed.mesh, nothing, level));
  solver.adopt(parent, closed, open);
  CHECK(farthest_from(solver, 5) < 1e-12);
  settings.boundaries.push_back({.group = "left", .kind = AcousticBoundaryKind::open, .radius = 1});
  AcousticSolver two(closed.mesh, settings);
  two.set_state(state_of(closed.mesh, nothing, level));
  CHECK(two.adopt(parent, closed, open).energy_after > 1);
  CHECK(farthest_from(two, 5) == Approx(12));
}

TEST_CASE("three pockets that meet at once are at rest, too") {
  const mesh::Mesh parent = box(2);
  const auto open = without(parent, 9, 9);
  std::vector<std::int32_t> keep(parent.num_cells());
  for (std::int32_t cell = 0; cell < parent.num_cells(); ++cell) {
    const double x = parent.point(parent.vertices_of(cell)[0])[0];
    keep[cell] = x < 0.45 || (x > 0.75 && x < 1.25) || x > 1.55;
  }
  const auto closed = transfer::strip(parent, keep);
  AcousticSolver solver(closed.mesh, unit_medium());
  solver.set_state(state_of(closed.mesh, nothing, [](double x) { return x < 0.6 ? 3.0 : x < 1.4 ? -1.0 : 8.0; }));
  CHECK(solver.adopt(parent, closed, open).energy_after < 1e-12);
}

TEST_CASE("a contact that moves on takes neither pressure nor velocity from one pocket to the other") {
  const mesh::Mesh parent = box(2);
  const auto first = without(parent, 0.85, 1.1), second = without(parent, 0.6, 0.85),
             third = without(parent, 0.85, 1.4);
  AcousticSolver solver(first.mesh, unit_medium());
  solver.set_state(state_of(first.mesh, nothing, [](double x) { return x < 1 ? -7.0 : 5.0; }));
  CHECK(solver.adopt(parent, first, second).energy_after < 1e-12);
  solver.set_state(state_of(second.mesh, nothing, [](double x) { return x < 0.75 ? -7.0 : 5.0; }));
  CHECK(solver.adopt(parent, second, third).energy_after < 1e-12);
  solver.adopt(parent, third, first);
  solver.set_state(state_of(
      first.mesh, [](double x) { return x < 1 ? 1.0 : 3.0; }, nothing));
  solver.adopt(parent, first, second);
  double farthest = 0;  // at 0.85 was the end of the one on the left
  for (std::int32_t v = 0; v < second.mesh.num_vertices(); ++v) {
    if (second.mesh.point(v)[0] > 0.84) farthest = std::max(farthest, std::abs(solver.state().p[v] - 3));
  }
  CHECK(base::largest(parent.comm, farthest) < 1e-12);
}

TEST_CASE("opened air begins between its neighbours") {
  const mesh::Mesh parent = box(2);
  const auto open = without(parent, 9, 9), closed = without(parent, 0.85, 1.15);
  AcousticSolver solver(closed.mesh, unit_medium());
  solver.set_state(state_of(
      closed.mesh, [](double x) { return x < 1 ? 1.0 : 3.0; }, nothing));
  solver.adopt(parent, closed, open);
  bool is_between = true, has_kept = true;
  for (std::int32_t v = 0; v < open.mesh.num_vertices(); ++v) {
    const double x = open.mesh.point(v)[0], p = solver.state().p[v];
    is_between = is_between && p >= 1 - 1e-14 && p <= 3 + 1e-14;
    if (x < 0.84) has_kept = has_kept && p == 1;
    if (x > 1.16) has_kept = has_kept && p == 3;
  }
  CHECK(is_between);
  CHECK(has_kept);
}

TEST_CASE("layers and walls go on where their cells and vertices stay, on meshes that are stripped and restored") {
  for (const int d : {2, 3}) {
    const mesh::Mesh parent = box(d);
    AcousticSettings settings = unit_medium();
    settings.boundaries = {{.group = "top", .kind = AcousticBoundaryKind::yielding},
                           {.group = "bottom", .kind = AcousticBoundaryKind::viscothermal}};
    settings.boundaries[0].mass = 0.2;
    settings.boundaries[0].resistance = 0.1;
    settings.boundaries[0].stiffness = 3;
    settings.boundaries[1].kinematic_viscosity = settings.boundaries[1].thermal_diffusivity = 0.1;
    settings.layers = {{.sides = {BoxSide::x_max}, .thickness = 0.4}};
    settings.spectral_radius = 0.8;
    const auto open = without(parent, 9, 9), same = without(parent, 9, 9), closed = without(parent, 0.95, 1.15);
    AcousticSolver solver(open.mesh, settings), goes_on(open.mesh, settings);
    for (AcousticSolver* each : {&solver, &goes_on}) {
      each->set_state(state_of(open.mesh, bump, nothing));
      CHECK(each->advance(1.5).converged);
    }
    const Adoption none = goes_on.adopt(parent, open, same);
    CHECK(none.energy_after == none.energy_before);
    CHECK(goes_on.state().p == solver.state().p);
    CHECK(goes_on.state().psi == solver.state().psi);
    CHECK(goes_on.state().layer_flux == solver.state().layer_flux);
    CHECK(goes_on.state().wall_motion == solver.state().wall_motion);
    CHECK(goes_on.state().earlier == solver.state().earlier);
    CHECK(goes_on.state().rates.psi == solver.state().rates.psi);
    CHECK(goes_on.state().rates.wall_motion == solver.state().rates.wall_motion);
    solver.drop_caches();
    CHECK(solver.advance(0.3).converged);
    CHECK(goes_on.advance(0.3).converged);
    CHECK(goes_on.state().p == solver.state().p);

    // There and back: what has always been there is as before.
    const State before = goes_on.state();
    goes_on.adopt(parent, same, closed);
    goes_on.adopt(parent, closed, same);
    CHECK(goes_on.state().layer_flux == before.layer_flux);
    CHECK(goes_on.state().wall_motion.size() == before.wall_motion.size());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < before.wall_motion.size(); ++i) {
      kept += goes_on.state().wall_motion[i] == before.wall_motion[i];
    }
    const double part =
        static_cast<double>(base::sum(parent.comm, static_cast<std::int64_t>(kept))) /
        static_cast<double>(base::sum(parent.comm, static_cast<std::int64_t>(before.wall_motion.size())));
    CHECK(part > 0.9);
    CHECK(part < 1);
  }
}

TEST_CASE("a layer that loses a cell is refused") {
  const mesh::Mesh parent = box(2);
  AcousticSettings settings = unit_medium();
  settings.layers = {{.sides = {BoxSide::x_max}, .thickness = 0.4}};
  const auto open = without(parent, 9, 9), closed = without(parent, 1.7, 1.75);
  AcousticSolver solver(open.mesh, settings);
  CHECK_THROWS_WITH(solver.adopt(parent, open, closed), Catch::Contains("nothing closes in the absorbing layers"));
}

}  // namespace vocalis::acoustic
