#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;

/// A plane vortex, v = F(t) (sin kx cos ky, -cos kx sin ky), with a pressure of its own shape, and the force it needs.
struct Vortex {
  double density = 1, viscosity = 0.1, k = pi;
  double phase(double t) const { return std::cos(2 * t) + 0.5; }
  double rate(double t) const { return -2 * std::sin(2 * t); }
  Point velocity(const Point& x, double t) const {
    return {phase(t) * std::sin(k * x[0]) * std::cos(k * x[1]), -phase(t) * std::cos(k * x[0]) * std::sin(k * x[1]), 0};
  }
  double level(double t) const { return 1 + std::sin(3 * t); }
  Point pressure(const Point& x, double t) const {
    return {level(t) * (std::cos(k * x[0]) * std::sin(0.5 * k * x[1]) + x[0]), 0, 0};
  }
  Point force(const Point& x, double t) const {
    const double f = phase(t), g = level(t);
    const Point shape = velocity(x, t);
    const Point slope = {g * (-k * std::sin(k * x[0]) * std::sin(0.5 * k * x[1]) + 1),
                         g * 0.5 * k * std::cos(k * x[0]) * std::cos(0.5 * k * x[1]), 0};
    const Point convection = {0.5 * k * f * f * std::sin(2 * k * x[0]), 0.5 * k * f * f * std::sin(2 * k * x[1]), 0};
    Point result = {0, 0, 0};
    for (int i = 0; i < 2; ++i) {
      result[i] = density * (shape[i] * rate(t) / f + convection[i]) + 2 * viscosity * k * k * shape[i] + slope[i];
    }
    return result;
  }
};

/// A motion of the mesh that the flow knows nothing of.
Point swaying(const Point& x, double t) {
  const double a = 0.08 * std::sin(4 * t);
  return {a * std::sin(pi * x[0]) * std::sin(2 * pi * x[1]), -a * std::sin(2 * pi * x[0]) * std::sin(pi * x[1]), 0};
}

FlowSettings settings_of(const Vortex& vortex) {
  FlowSettings settings;
  settings.density = vortex.density;
  settings.viscosity = vortex.viscosity;
  settings.boundaries = velocity_all_around();
  return settings;
}

Prescribed prescribe(const Vortex& vortex, bool moving) {
  Prescribed result;
  result.velocity = [vortex](const Point& x, double t) { return vortex.velocity(x, t); };
  result.fluid_force = [vortex](const Point& x, double t) { return vortex.force(x, t); };
  if (moving) result.mesh_displacement = swaying;
  return result;
}

/// Nodal values at the end of a run to time 0.4, for differences between time steps on one mesh.
std::vector<double> vortex_at_end(int steps, TimeSettings scheme, bool moving, const mesh::Mesh& mesh) {
  const Vortex vortex;
  FlowSettings settings = settings_of(vortex);
  settings.newton_tolerance = 1e-12;
  const Prescribed prescribed = prescribe(vortex, moving);
  FsiSolver solver(mesh, settings, scheme, prescribed);
  start_from(solver, prescribed.velocity, prescribed.mesh_displacement);
  const StepReport report = run(solver, 0.4 / steps, steps);
  INFO(report.reason << " " << report.residual);
  REQUIRE_ON_ALL_RANKS(report.converged);
  return solver.state().velocity.values;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(base::sum(MPI_COMM_WORLD, sum));
}

Errors vortex_errors(Elements elements, int cells, double dt, int steps, TimeSettings scheme, bool moving) {
  const Vortex vortex;
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {cells, cells, 0});
  FlowSettings settings = settings_of(vortex);
  settings.elements = elements;
  settings.newton_tolerance = 1e-11;
  const Prescribed prescribed = prescribe(vortex, moving);
  FsiSolver solver(mesh, settings, scheme, prescribed);
  start_from(solver, prescribed.velocity, prescribed.mesh_displacement);
  const StepReport report = run(solver, dt, steps);
  INFO(report.reason << " " << report.residual);
  REQUIRE_ON_ALL_RANKS(report.converged);
  const double time = solver.time();
  const double pressure_time = scheme.scheme == TimeScheme::theta ? time - (1 - scheme.theta) * dt : time;
  // Where the mesh is at the pressure's time; it moves evenly over a step.
  fem::Field earlier = solver.state().displacement;
  for (std::size_t i = 0; i < earlier.values.size(); ++i) {
    earlier.values[i] -=
        (time - pressure_time) / dt * (earlier.values[i] - solver.state().displacement_before.values[i]);
  }
  Errors errors;
  errors.velocity = l2_error(
      solver, moved(solver, solver.state().displacement), solver.state().velocity,
      [&](const Point& p) { return vortex.velocity(p, time); }, false);
  errors.pressure = l2_error(
      solver, moved(solver, earlier), solver.state().pressure,
      [&](const Point& p) { return vortex.pressure(p, pressure_time); }, true);
  return errors;
}

constexpr TimeSettings midpoint = {.scheme = TimeScheme::theta, .theta = 0.5};
constexpr TimeSettings backward = {.scheme = TimeScheme::theta, .theta = 1};
constexpr TimeSettings bdf2 = {.scheme = TimeScheme::bdf2};

double order(double coarse, double fine) { return std::log2(coarse / fine); }

/// On three meshes, each with half the cells of the next, with steps that keep the error in time below.
void check_flow_orders(Elements elements, int coarse, double velocity, double least_of_pressure) {
  for (const bool moving : {false, true}) {
    Errors last;
    for (const int cells : {coarse, 2 * coarse, 4 * coarse}) {
      const bool is_linear = elements == Elements::p1p1;
      const double dt = is_linear ? 0.064 / cells : 0.1 / (cells * cells);
      const int steps = is_linear ? 5 * cells / 2 : cells * cells / 4;
      const Errors errors = vortex_errors(elements, cells, dt, steps, bdf2, moving);
      INFO((moving ? "moving " : "fixed ")
           << cells << " velocity " << errors.velocity << " pressure " << errors.pressure << " orders "
           << order(last.velocity, errors.velocity) << " " << order(last.pressure, errors.pressure));
      if (cells == 4 * coarse) {
        CHECK(order(last.velocity, errors.velocity) == Approx(velocity).margin(0.2));
        CHECK(order(last.pressure, errors.pressure) > least_of_pressure);
      }
      last = errors;
    }
  }
}

}  // namespace

TEST_CASE("P1P1 flow converges with order two in space, on fixed and on moving meshes") {
  check_flow_orders(Elements::p1p1, 8, 2, 1.3);
}

TEST_CASE("P2P1 flow converges with order three in velocity and two in pressure, on fixed and on moving meshes") {
  check_flow_orders(Elements::p2p1, 6, 3, 1.8);
}

TEST_CASE("flow converges in time with the order of its scheme, on fixed and on moving meshes") {
  const mesh::Mesh mesh = box_of("fluid", {1, 1, 0}, {8, 8, 0});
  for (const bool moving : {false, true}) {
    for (const auto& [scheme, expected] : {std::pair(midpoint, 2), std::pair(backward, 1), std::pair(bdf2, 2)}) {
      const std::vector<double> reference = vortex_at_end(256, expected == 1 ? midpoint : scheme, moving, mesh);
      const double coarse = distance(vortex_at_end(32, scheme, moving, mesh), reference);
      const double fine = distance(vortex_at_end(64, scheme, moving, mesh), reference);
      INFO((moving ? "moving" : "fixed") << " coarse " << coarse << " fine " << fine << " order "
                                         << order(coarse, fine));
      CHECK(order(coarse, fine) == Approx(expected).margin(0.2));
    }
  }
}

}  // namespace vocalis::fsi
