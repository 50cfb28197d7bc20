#include <sstream>

#include "tests/stability/parts.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double height = 0.5;  ///< of the flag [m]

/// A flag 0.7 x 0.1 at the left of a square box of fluid that is open at the right.
mesh::Mesh flag_in_box() {
  const auto is_flag = [](const std::array<double, 2>& x) { return x[0] < 0.7 && std::abs(x[1] - height) < 0.05; };
  Parts parts;
  parts.regions = {"fluid", "flag"};
  parts.region_at = [=](const std::array<double, 2>& x) { return is_flag(x) ? 1 : 0; };
  parts.groups = {"clamp", "right"};
  parts.group_at = [=](const std::array<double, 2>& x) { return is_flag(x) ? 0 : x[0] < 1 ? -1 : 1; };
  return box_of_parts({1, 1}, {20, 20}, parts);
}

struct Sag {
  StepReport report;
  double time = 0;     ///< how far it came, of 1 [s]
  double tip = 0;      ///< how far down [m]
  double quality = 1;  ///< smallest of the mesh there
};

/// Pulls the flag down by a weight of its own that grows to its full size in 1 s, as in CSM1 of Turek and Hron 2006 but
/// until it sags by half of its length. Steps of 1/20 s are halved down to 1/1280 s where they fail.
Sag pull_down(Elements elements, Smoother smoother) {
  const mesh::Mesh mesh = flag_in_box();
  FlowSettings settings;
  settings.elements = elements;
  settings.density = 1;
  settings.viscosity = 1e-3;
  settings.boundaries = {boundary("clamp", FlowBoundaryKind::fixed), boundary("right", FlowBoundaryKind::outlet)};
  settings.solids.emplace_back().region = "flag";
  settings.solids[0].model = SolidModel::saint_venant_kirchhoff;
  settings.solids[0].density = 1;
  settings.solids[0].young_modulus = 1400;
  settings.smoother = smoother;
  Prescribed prescribed;
  prescribed.solid_force = [=](const Point&, double t) -> Point { return {0, -40 * t, 0}; };
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::theta, .theta = 1}, prescribed);
  Sag sag;
  for (double dt = 0.05; solver.time() < 1 - 1e-9 && dt > 0.05 / 100;) {
    sag.report = run(solver, dt, 1);
    if (!sag.report.converged) dt /= 2;
  }
  sag.time = solver.time();
  sag.quality = smallest_quality(solver);
  const fem::Field displacement = solver.displacement_at_vertices();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) sag.tip = std::max(sag.tip, -displacement.at(v)[1]);
  sag.tip = base::largest(MPI_COMM_WORLD, sag.tip);
  return sag;
}

std::string told(const Sag& sag) {
  std::ostringstream text;
  text << "time " << sag.time << " tip " << sag.tip << " quality " << sag.quality << " " << sag.report.reason;
  return text.str();
}

}  // namespace

TEST_CASE("a flag that sags far inverts the mesh of the linear smoother, not of the non-linear one") {
  for (const Elements elements : {Elements::p1p1, Elements::p2p1}) {
    const Sag linear = pull_down(elements, Smoother::linear), nonlinear = pull_down(elements, Smoother::nonlinear);
    INFO((elements == Elements::p1p1 ? "P1P1" : "P2P1")
         << " linear: " << told(linear) << "; non-linear: " << told(nonlinear));
    CHECK_FALSE(linear.report.converged);
    CHECK(linear.report.inverted);
    CHECK(linear.time < 0.8);
    CHECK(nonlinear.report.converged);
    CHECK(nonlinear.tip > 1.3 * linear.tip);
    CHECK(nonlinear.quality > 0.1);
  }
}

}  // namespace vocalis::fsi
