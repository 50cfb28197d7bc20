#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
constexpr int cells = 16;

FlowSettings settings_of(Elements elements, bool is_stabilised, double viscosity) {
  FlowSettings settings;
  settings.elements = elements;
  settings.streamline_stabilisation = is_stabilised;
  settings.density = 1;
  settings.viscosity = viscosity;
  settings.boundaries = velocity_all_around();
  return settings;
}

struct Wiggles {
  StepReport report;
  double overshoot = 0;  ///< of the velocity across, which is 1 in front of the layer
  double far_away = 0;   ///< largest error more than four cells in front of it
};

/// The flow (1, w(x)) with w = 1 that must become 0 at the right in a layer much thinner than a cell: an exact solution
/// without pressure, at cell Reynolds number 1 / (cells ν).
Wiggles run_into_layer(Elements elements, bool is_stabilised, double viscosity) {
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {cells, cells, 0});
  Prescribed prescribed;
  prescribed.velocity = [](const Point& x, double) -> Point { return {1, x[0] < 1 - 1e-9 ? 1.0 : 0.0, 0}; };
  FsiSolver solver(mesh, settings_of(elements, is_stabilised, viscosity), {.scheme = TimeScheme::bdf2}, prescribed);
  start_from(solver, prescribed.velocity, nullptr);
  Wiggles result;
  result.report = run(solver, 0.1, 20);
  for (std::int32_t dof = 0; dof < solver.velocity_space().dofs.num_owned; ++dof) {
    const double x = solver.continuum().reference_points[2 * static_cast<std::size_t>(dof)];
    const double error = solver.state().velocity.at(dof)[1] - 1;
    result.overshoot = std::max(result.overshoot, error);
    if (x < 1 - 4.0 / cells) result.far_away = std::max(result.far_away, std::abs(error));
  }
  result.overshoot = base::largest(MPI_COMM_WORLD, result.overshoot);
  result.far_away = base::largest(MPI_COMM_WORLD, result.far_away);
  return result;
}

/// The error of smooth vortices that are carried along, in L2 after time 1: the price of stabilisation, or its worth.
double error_of_vortices(Elements elements, bool is_stabilised, double viscosity) {
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {cells, cells, 0});
  Prescribed prescribed;
  prescribed.velocity = [=](const Point& x, double t) -> Point {
    const double a = 2 * pi * (x[0] - t), b = 2 * pi * (x[1] - 0.5 * t);
    const double size = std::exp(-8 * pi * pi * viscosity * t);
    return {1 + size * std::sin(a) * std::cos(b), 0.5 - size * std::cos(a) * std::sin(b), 0};
  };
  FsiSolver solver(mesh, settings_of(elements, is_stabilised, viscosity), {.scheme = TimeScheme::bdf2}, prescribed);
  start_from(solver, prescribed.velocity, nullptr);
  const StepReport report = run(solver, 0.02, 50);
  INFO(report.reason);
  CHECK(report.converged);
  return l2_error(
      solver, solver.continuum().reference_points, solver.state().velocity,
      [&](const Point& x) { return prescribed.velocity(x, solver.time()); }, false);
}

}  // namespace

TEST_CASE("a layer thinner than a cell disturbs the whole flow without streamline stabilisation, not with it") {
  constexpr double viscosity = 1e-3;  // cell Reynolds number 62
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const Wiggles bare = run_into_layer(elements, false, viscosity);
    const Wiggles stabilised = run_into_layer(elements, true, viscosity);
    INFO((elements == Elements::p1p1 ? "P1P1" : "P2P1")
         << " overshoot " << bare.overshoot << ", stabilised " << stabilised.overshoot << "; far away " << bare.far_away
         << ", stabilised " << stabilised.far_away);
    CHECK(bare.overshoot > 0.5);
    CHECK(bare.far_away > 0.4);
    CHECK(stabilised.report.converged);
    CHECK(stabilised.overshoot < 0.45);
    CHECK(stabilised.far_away < 0.05);
  }
}

TEST_CASE("P2P1 does not converge at a layer at high Reynolds number without streamline stabilisation") {
  const Wiggles bare = run_into_layer(Elements::p2p1, false, 1e-5);
  const Wiggles stabilised = run_into_layer(Elements::p2p1, true, 1e-5);
  INFO(bare.report.reason << "; stabilised: far away " << stabilised.far_away);
  CHECK_FALSE(bare.report.converged);
  CHECK(stabilised.report.converged);
  CHECK(stabilised.far_away < 0.05);
}

TEST_CASE("smooth vortices gain from streamline stabilisation of P2P1 at high Reynolds numbers and lose little else",
          "[serial]") {
  for (const double viscosity : {1e-3, 1e-5}) {
    const double bare = error_of_vortices(Elements::p2p1, false, viscosity);
    const double stabilised = error_of_vortices(Elements::p2p1, true, viscosity);
    INFO("viscosity " << viscosity << " errors " << bare << ", stabilised " << stabilised);
    CHECK(stabilised < (viscosity < 1e-4 ? 0.7 : 1.5) * bare);
  }
}

}  // namespace vocalis::fsi
