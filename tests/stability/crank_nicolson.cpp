#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double dt = 0.05;
constexpr int steps = 60;

constexpr TimeSettings crank_nicolson = {.scheme = TimeScheme::theta, .theta = 0.5};
constexpr TimeSettings shifted = {.scheme = TimeScheme::theta, .theta = 0.5 + dt};
constexpr TimeSettings bdf2 = {.scheme = TimeScheme::bdf2};

/// Sizes of the sawtooth |x₊ - 2 x + x₋| / 4 of a field's entries, largest over them, after some steps and at the end.
struct Sawtooth {
  double early = 0, late = 0;
};

template <class Field>
Sawtooth sawtooth(FsiSolver& solver, const Field& field) {
  Sawtooth result;
  std::vector<double> before, now, next;
  for (int step = 0; step < steps; ++step) {
    const StepReport report = run(solver, dt, 1);
    INFO(report.reason << " " << report.residual);
    REQUIRE_ON_ALL_RANKS(report.converged);
    before = std::exchange(now, std::exchange(next, field(solver.state())));
    if (step != 4 && step + 1 != steps) continue;
    double size = 0;
    for (std::size_t i = 0; i < now.size(); ++i) {
      size = std::max(size, std::abs(next[i] - 2 * now[i] + before[i]) / 4);
    }
    (step == 4 ? result.early : result.late) = base::largest(MPI_COMM_WORLD, size);
  }
  return result;
}

/// The pressure [Pa] of a flow that begins as a plug, at once and not free of divergence on the mesh, and ends as that
/// of Poiseuille with 24 Pa at the left.
Sawtooth of_pressure(Elements elements, const TimeSettings& scheme) {
  const mesh::Mesh mesh = box_of("fluid", {2, 1, 0}, {16, 8, 0});
  FlowSettings settings;
  settings.elements = elements;
  settings.density = 1;
  settings.viscosity = 1;
  settings.boundaries = {boundary("left", FlowBoundaryKind::velocity), boundary("right", FlowBoundaryKind::outlet)};
  settings.boundaries[0].velocity = {1, 0, 0};
  settings.boundaries[0].profile = VelocityProfile::parabolic;
  FsiSolver solver(mesh, settings, scheme);
  start_from(
      solver,
      [](const Point& x, double) -> Point {
        return {x[0] > 0 && x[1] > 0 && x[1] < 1 ? 1.0 : 0.0, 0, 0};
      },
      nullptr);
  return sawtooth(solver, [](const State& state) { return state.pressure.values; });
}

/// The velocity [m/s] of a stiff and damped beam that is struck, so that all of it but its clamp begins with 1 m/s.
Sawtooth of_stiff_solid(Elements elements, const TimeSettings& scheme) {
  const mesh::Mesh mesh = box_of("solid", {4, 1, 0}, {16, 4, 0});
  FlowSettings settings;
  settings.elements = elements;
  settings.solids.emplace_back().region = "solid";
  settings.solids[0].density = 1;
  settings.solids[0].young_modulus = 1e4;
  settings.solids[0].damping = 500;
  settings.boundaries = {boundary("left", FlowBoundaryKind::fixed)};
  FsiSolver solver(mesh, settings, scheme);
  start_from(
      solver,
      [](const Point& x, double) -> Point {
        return {0, x[0] > 0 ? -1.0 : 0.0, 0};
      },
      nullptr);
  return sawtooth(solver, [](const State& state) { return state.velocity.values; });
}

void check_that_it_rings(const std::function<Sawtooth(Elements, const TimeSettings&)>& sawtooth_of) {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const Sawtooth plain = sawtooth_of(elements, crank_nicolson);
    const Sawtooth shift = sawtooth_of(elements, shifted), multistep = sawtooth_of(elements, bdf2);
    INFO((elements == Elements::p1p1 ? "P1P1" : "P2P1")
         << " sawtooth after 5 and 60 steps: theta 1/2 " << plain.early << " " << plain.late << ", 1/2 + dt "
         << shift.early << " " << shift.late << ", BDF2 " << multistep.early << " " << multistep.late);
    CHECK(plain.late > 0.4 * plain.early);
    CHECK(shift.late < 1e-3 * plain.late);
    CHECK(multistep.late < 1e-3 * plain.late);
  }
}

}  // namespace

TEST_CASE("the pressure after rough initial values rings with theta = 1/2, not with theta = 1/2 + dt or BDF2") {
  check_that_it_rings(of_pressure);
}

TEST_CASE("a stiff solid that is struck rings with theta = 1/2, not with theta = 1/2 + dt or BDF2", "[serial]") {
  check_that_it_rings(of_stiff_solid);
}

}  // namespace vocalis::fsi
