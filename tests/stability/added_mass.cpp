#include "fsi_solver/measures/energy.hpp"
#include "tests/stability/loose_coupling.hpp"
#include "tests/stability/parts.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
const Channel channel;

double exact_largest_added_mass() {
  return channel.length / (pi * std::tanh(pi * channel.half_height / channel.length));
}

/// The upper half of the same channel for the unified continuum, symmetric at the bottom, the wall on top of it clamped
/// at its ends.
mesh::Mesh channel_mesh() {
  const auto is_wall = [](const std::array<double, 2>& x) { return x[1] > channel.half_height; };
  Parts parts;
  parts.regions = {"fluid", "wall"};
  parts.region_at = [=](const std::array<double, 2>& x) { return is_wall(x) ? 1 : 0; };
  parts.groups = {"ends", "clamps", "axis"};
  parts.group_at = [=](const std::array<double, 2>& x) {
    if (x[0] > 0 && x[0] < channel.length) return x[1] > 0 ? -1 : 2;
    return is_wall(x) ? 1 : 0;
  };
  return box_of_parts({channel.length, channel.half_height + channel.wall}, {30, 6}, parts);
}

FlowSettings channel_settings(double density_ratio, Elements elements) {
  FlowSettings settings;
  settings.elements = elements;
  settings.density = channel.fluid_density;
  settings.viscosity = 3e-3;
  settings.boundaries = {boundary("ends", FlowBoundaryKind::outlet), boundary("clamps", FlowBoundaryKind::fixed),
                         boundary("axis", FlowBoundaryKind::symmetry)};
  settings.solids.emplace_back().region = "wall";
  settings.solids[0].density = density_ratio * channel.fluid_density;
  settings.solids[0].young_modulus = channel.young_modulus;
  settings.solids[0].poisson_ratio = 0.3;
  return settings;
}

struct Course {
  double largest = 0;  ///< energy of the run over that after its first step
  double last = 0;     ///< at its end
};

/// Pushes the wall outwards and lets the channel go on by itself.
Course push(const FlowSettings& settings, double dt, int steps) {
  const mesh::Mesh mesh = channel_mesh();
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2});
  start_from(
      solver,
      [](const Point& x, double) -> Point {
        return {0, x[1] < channel.half_height ? 0 : 1e-3 * std::sin(pi * x[0] / channel.length), 0};
      },
      nullptr);
  const OpenFacets open = find_open_facets(solver);
  double first = 0;
  Course result;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = solver.try_step(dt);
    INFO("step " << step << " " << report.reason << " residual " << report.residual);
    REQUIRE_ON_ALL_RANKS(report.converged);
    solver.accept();
    const EnergyRates rates = energy(solver, open);
    result.last = rates.kinetic + rates.elastic;
    if (step == 0) first = result.last;
    result.last /= first;
    result.largest = std::max(result.largest, result.last);
  }
  return result;
}

}  // namespace

TEST_CASE("added mass makes a loosely coupled scheme unstable at every step, from one wall's mass on") {
  const AddedMass added_mass(channel, 50, 10);
  const double largest = added_mass.largest_eigenvalue();
  CHECK(largest == Approx(exact_largest_added_mass()).epsilon(0.01));
  const auto density_of = [&](double ratio) { return ratio * channel.fluid_density * largest / channel.wall; };
  for (const double dt : {1e-4, 1e-5, 1e-6}) {
    for (const double ratio : {0.2, 0.5, 0.9, 0.99}) {
      const Growth growth = loosely_coupled(channel, added_mass, density_of(ratio), dt, ratio < 0.9 ? 200 : 2000);
      INFO("dt " << dt << " mass ratio " << ratio << " growth " << growth.a_step);
      CHECK(growth.a_step - 1 == Approx(1 / ratio - 1).epsilon(0.1));
    }
    for (const double ratio : {1.01, 2.0}) {
      const Growth growth = loosely_coupled(channel, added_mass, density_of(ratio), dt, 2000);
      INFO("dt " << dt << " mass ratio " << ratio << " largest " << growth.largest);
      CHECK(growth.largest < 1.01);
    }
  }
}

TEST_CASE("solving fluid and solid together is stable at every ratio of their densities", "[serial]") {
  const AddedMass added_mass(channel, 50, 10);
  for (const double ratio : {1000.0, 100.0, 10.0, 1.0, 0.1}) {
    const Growth loose = loosely_coupled(channel, added_mass, ratio * channel.fluid_density, 1e-5, 60);
    INFO("density ratio " << ratio << " loosely coupled: factor a step " << loose.a_step << " over all "
                          << loose.largest);
    if (ratio > exact_largest_added_mass() / channel.wall) {
      CHECK(loose.largest < 1.01);
    } else {
      CHECK(loose.a_step > 0.9 * exact_largest_added_mass() / channel.wall / ratio);
    }
    for (const double dt : {1e-3, 1e-4, 1e-5}) {
      for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
        const Course together = push(channel_settings(ratio, elements), dt, 30);
        INFO("dt " << dt << " together: largest energy " << together.largest << " last " << together.last);
        CHECK(together.largest < 1.001);
        CHECK(together.last < 1);
      }
    }
  }
}

}  // namespace vocalis::fsi
