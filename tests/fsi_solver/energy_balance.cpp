#include "fsi_solver/measures/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "fsi_solver/measures/energy.hpp"
#include "fsi_solver/solution/assembly.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/boxes.hpp"

namespace vocalis::fsi {

namespace {

/// What the balance leaves of an energy begun at 0 whose rate is the power, after each step.
std::vector<double> left_of(TimeScheme scheme, const std::vector<double>& steps, bool anew,
                            const std::function<double(double)>& course, const std::function<double(double)>& power) {
  EnergyBalance balance;
  std::vector<double> result;
  double time = 0, last = 0;
  for (const double dt : steps) {
    const Stage stage = make_stage({.scheme = scheme}, dt, anew ? 0 : last);
    time += last = dt;
    const double now = course(time), next = course(time + dt), before = course(time - dt);
    EnergyRates rates;
    rates.kept = {now, 0.5 * (next - before), 0.5 * (next + before) - now, stage.ahead};
    rates.supplied = power(time - (1 - stage.weight) * dt);
    balance.advance(stage, rates);
    result.push_back(balance.left());
  }
  return result;
}

}  // namespace

TEST_CASE("A balance counts power up to where the energy is that the scheme keeps, whatever the steps", "[serial]") {
  const auto line = [](double t) { return 3 * t; };
  const auto slope = [](double) { return 3.0; };
  const auto square = [](double t) { return t * t; };
  const auto twice = [](double t) { return 2 * t; };
  const std::vector<double> steps = {0.2, 0.2, 0.1, 0.1, 0.3};
  for (const TimeScheme scheme : {TimeScheme::theta, TimeScheme::bdf2}) {
    for (const bool anew : {false, true}) {
      for (const double left : left_of(scheme, steps, anew, line, slope)) CHECK(left == Approx(0).margin(1e-12));
    }
    const std::vector<double> lefts = left_of(scheme, steps, false, square, twice);
    for (const double left : lefts) CHECK(left == Approx(lefts.front()).margin(1e-12));
  }
}

TEST_CASE("What a time scheme keeps of the energy of a swinging block stays, or falls") {
  const double dt = 5e-4;
  const mesh::Mesh mesh = test::box_of("tissue", {0.01, 0.01, 0}, {4, 4, 0});
  FlowSettings flow;
  flow.elements = Elements::p2p1;
  flow.newton_tolerance = 1e-12;
  flow.solids = {{.region = "tissue", .density = 1000, .young_modulus = 2000}};
  flow.boundaries = {{.group = "bottom", .kind = FlowBoundaryKind::fixed}};
  for (const double theta : {0.0, 0.5, 1.0}) {  // 0: BDF2
    TimeSettings time{.end = 1, .step = dt};
    time.scheme = theta > 0 ? TimeScheme::theta : TimeScheme::bdf2;
    time.theta = theta;
    FsiSolver solver(mesh, flow, time);
    State state = solver.state();
    for (std::int32_t dof = 0; dof < solver.velocity_space().num_dofs(); ++dof) {
      const double height = solver.continuum().reference_points[2 * static_cast<std::size_t>(dof) + 1];
      state.velocity.at(dof)[0] = 2 * height;
    }
    state.velocity_before = state.velocity;
    solver.set_state(state);
    const double begun = 1000 * 0.01 * 4 * std::pow(0.01, 3) / 6;  // ∫ ½ ρ (2 y)² [J]
    const OpenFacets open = find_open_facets(solver);
    EnergyBalance balance;
    double before = begun, rise = 0;
    for (int step = 0; step < 100; ++step) {
      REQUIRE_ON_ALL_RANKS(solver.try_step(dt).converged);
      solver.accept();
      const EnergyRates rates = energy(solver, open);
      balance.advance(solver.assembly().fields().stage(), rates);
      const double left = balance.left();
      rise = std::max(rise, left - before);
      before = left;
    }
    INFO("theta " << theta << ": rise in a step " << rise / begun << ", left " << before / begun);
    // The block's energy is no square. What that makes is less than what a scheme loses, and θ = ½ loses nothing.
    CHECK(rise < (theta == 0.5 ? 1e-6 : 1e-12) * begun);
    CHECK(before < (theta == 0.5 ? 1.00001 : 0.995) * begun);
  }
}

}  // namespace vocalis::fsi
