#include <sstream>

#include "fsi_solver/measures/energy.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

/// A plane channel 2 x 1 with slip at top and bottom, driven from the left, open on the right, where a vortex is.
struct Vortex {
  double mean = 0;   ///< velocity of the channel [m/s], negative: sucked
  double swirl = 0;  ///< largest velocity about the vortex [m/s]
};

struct Course {
  StepReport report;
  double first = 0, largest = 0, last = 0;  ///< kinetic energy [J]
};

Course run_vortex(const Vortex& vortex, Elements elements, FlowBoundaryKind kind, double backflow_stabilisation) {
  const int cells = elements == Elements::p1p1 ? 24 : 16;
  const mesh::Mesh mesh = box_of("fluid", {2, 1, 0}, {cells, cells / 2, 0});
  FlowSettings settings;
  settings.elements = elements;
  settings.backflow_stabilisation = backflow_stabilisation;
  settings.density = 1;
  settings.viscosity = 1e-3;
  settings.boundaries = {boundary("left", FlowBoundaryKind::velocity), boundary("right", kind),
                         boundary("top", FlowBoundaryKind::symmetry), boundary("bottom", FlowBoundaryKind::symmetry)};
  settings.boundaries[0].velocity = {vortex.mean, 0, 0};
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2});
  start_from(
      solver,
      [&](const Point& x, double) -> Point {
        const double radius = 0.2, dx = (x[0] - 1.6) / radius, dy = (x[1] - 0.5) / radius;
        const double speed = vortex.swirl * std::exp(0.5 - 0.5 * (dx * dx + dy * dy));
        return {vortex.mean - speed * dy, speed * dx, 0};
      },
      nullptr);
  const OpenFacets open = find_open_facets(solver);
  Course course;
  for (int step = 0; step < 75; ++step) {
    course.report = run(solver, 0.04, 1);
    if (!course.report.converged) break;
    course.last = energy(solver, open).kinetic;
    if (step == 0) course.first = course.last;
    course.largest = std::max(course.largest, course.last);
  }
  return course;
}

std::string told(const Course& course) {
  std::ostringstream text;
  text << "energy " << course.first << ", largest " << course.largest << ", last " << course.last << " "
       << course.report.reason;
  return text.str();
}

}  // namespace

TEST_CASE("a vortex that leaves by an outlet brings energy in without backflow stabilisation, none with it") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const Vortex vortex = {.mean = 0.5, .swirl = 5};
    const Course bare = run_vortex(vortex, elements, FlowBoundaryKind::outlet, 0);
    const Course stabilised = run_vortex(vortex, elements, FlowBoundaryKind::outlet, 0.5);
    INFO((elements == Elements::p1p1 ? "P1P1" : "P2P1")
         << " without: " << told(bare) << "; with: " << told(stabilised));
    CHECK(bare.largest > 10 * bare.first);
    CHECK(stabilised.report.converged);
    CHECK(stabilised.largest < 1.01 * stabilised.first);
    CHECK(stabilised.last < 0.1 * stabilised.first);
  }
}

TEST_CASE("what is sucked in through a given pressure gains energy, through a given total pressure it does not",
          "[serial]") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const Vortex vortex = {.mean = -1, .swirl = 2};
    const Course pressure = run_vortex(vortex, elements, FlowBoundaryKind::pressure, 0.5);
    const Course total = run_vortex(vortex, elements, FlowBoundaryKind::total_pressure, 0.5);
    INFO((elements == Elements::p1p1 ? "P1P1" : "P2P1")
         << " pressure: " << told(pressure) << "; total: " << told(total));
    CHECK(pressure.largest > 2 * pressure.first);
    CHECK(total.report.converged);
    CHECK(total.largest < 1.01 * total.first);
    CHECK(total.last < 0.7 * total.first);
  }
}

}  // namespace vocalis::fsi
