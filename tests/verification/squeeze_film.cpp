// The film between plates that approach each other: h << L, ends open, so slow that viscosity alone holds (Reynolds
// 1886, Phil. Trans. R. Soc. 177, 157): p = 6 µ V / h³ (L²/4 - x²), F = µ V L³ / h³ per metre of depth.
#include "fsi_solver/measures/body.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double length = 0.02, gap = 0.001, speed = 1e-3, viscosity = 0.1;  // [m], [m/s], [Pa s]; Re = 1e-5

double exact_force(double h) { return viscosity * speed * std::pow(length / h, 3); }
double exact_pressure(double h) { return 1.5 * viscosity * speed * length * length / (h * h * h); }

FlowSettings film(Elements elements) {
  FlowSettings flow;
  flow.elements = elements;
  flow.density = 1;
  flow.viscosity = viscosity;
  flow.newton_tolerance = 1e-9;
  flow.boundaries = {boundary("top", FlowBoundaryKind::velocity), boundary("left", FlowBoundaryKind::outlet),
                     boundary("right", FlowBoundaryKind::outlet)};
  return flow;
}

struct Film {
  double force = 0;     ///< over the exact one
  double pressure = 0;  ///< in the middle of the lower plate, over the exact one
};

/// The upper plate sinks until half of the gap is left, and carries the mesh with it.
Film squeeze(Elements elements, int cells_across) {
  const mesh::Mesh mesh = box_of("fluid", {length, gap, 0}, {40, cells_across, 0});
  Prescribed prescribed;
  prescribed.velocity = [](const Point&, double) -> Point { return {0, -speed, 0}; };
  prescribed.mesh_displacement = [](const Point& x, double t) -> Point { return {0, -speed * t * x[1] / gap, 0}; };
  FsiSolver solver(mesh, film(elements), {.scheme = TimeScheme::bdf2}, prescribed);
  const StepReport report = run(solver, 0.1 * gap / speed, 5);
  INFO(report.reason << " " << report.residual);
  REQUIRE_ON_ALL_RANKS(report.converged);
  const double h = gap - speed * solver.time();
  const fem::Field pressure = solver.fluid_pressure();
  double middle = 0;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    if (std::abs(x[0] - length / 2) < 1e-9 && x[1] < 1e-9) middle = pressure.at(v)[0];
  }
  return {.force = force_on(solver, make_body(solver, {"top"}))[1] / exact_force(h),
          .pressure = base::largest(MPI_COMM_WORLD, middle) / exact_pressure(h)};
}

}  // namespace

TEST_CASE("The film between approaching plates carries what lubrication theory says: P2P1 with two cells across") {
  for (const int cells : {2, 4, 8}) {
    const Film film = squeeze(Elements::p2p1, cells);
    INFO("P2P1, " << cells << " cells across: force " << film.force << " pressure " << film.pressure);
    CHECK(film.force == Approx(1).margin(0.05));
    CHECK(film.pressure == Approx(1).margin(0.05));
  }
}

// Linear cells have the parabola's values at their ends, which leaves 1 / n² of the flow out: with four cells across no
// linear element can be within 5 %.
TEST_CASE("The film of P1P1 carries 1 / (1 - 1/n²) of that with n cells across, within 5 % from five on") {
  for (const int cells : {2, 4, 5, 8}) {
    const Film film = squeeze(Elements::p1p1, cells);
    INFO("P1P1, " << cells << " cells across: force " << film.force << " pressure " << film.pressure);
    const double expected = 1 / (1 - 1.0 / (cells * cells));
    CHECK(film.force == Approx(expected).epsilon(0.01));
    CHECK(film.pressure == Approx(expected).epsilon(0.01));
    if (cells < 5) continue;
    CHECK(film.force == Approx(1).margin(0.05));
    CHECK(film.pressure == Approx(1).margin(0.05));
  }
}

}  // namespace vocalis::fsi
