#include <algorithm>
#include <sstream>

#include "fsi_solver/mesh_motion/mesh_motion.hpp"
#include "fsi_solver/mesh_motion/nonlinear_smoother.hpp"
#include "tests/fsi_solver/room.hpp"
#include "tests/stability/parts.hpp"
#include "tests/verification/flow_manufactured.hpp"

namespace vocalis::fsi {

namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
constexpr int steps = 24;  ///< a period

/// Where a block is that turns to and fro and shifts to and fro, a quarter of a period later.
fem::Field place_of(const Room& room, int step) {
  const double phase = 2 * pi * (step % steps) / steps;
  return room.moved(25 * std::sin(phase), 0.35 * std::cos(phase));
}

/// Smallest quality of the mesh at the beginning and after each of some periods, by a smoother that finds the vertices'
/// displacement from where they were in the step before: linear elasticity on the mesh as it is then.
std::vector<double> qualities_of_accumulating(int periods) {
  const Room rest(2, 18);
  Room room(2, 18);
  std::vector<double> result;
  fem::Field last = rest.at_rest();
  for (int step = 0; step <= periods * steps; ++step) {
    const fem::Field place = place_of(rest, step);
    fem::Field increment = place;
    for (std::size_t i = 0; i < place.values.size(); ++i) increment.values[i] -= last.values[i];
    last = place;
    MeshMotion(room.continuum, room.conditions, 1).extend(increment);
    for (std::size_t i = 0; i < place.values.size(); ++i) room.mesh.coordinates[i] += increment.values[i];
    if (step % steps == 0) result.push_back(room.quality(room.at_rest()));
  }
  return result;
}

/// The same by linear elasticity from the reference, and by the non-linear smoother that begins where the mesh was.
std::vector<double> qualities_of(Smoother kind, int periods) {
  const Room room(2, 18);
  MeshMotion linear(room.continuum, room.conditions, 1);
  NonlinearSmoother nonlinear(room.continuum, room.conditions, 1);
  std::vector<double> result;
  fem::Field last = room.at_rest();
  for (int step = 0; step <= periods * steps; ++step) {
    fem::Field place = place_of(room, step);
    kind == Smoother::linear ? linear.extend(place).converged : nonlinear.extend(place, last).converged;
    last = place;
    if (step % steps == 0) result.push_back(room.quality(place));
  }
  return result;
}

std::string listed(const std::vector<double>& values) {
  std::ostringstream text;
  text.precision(10);
  for (const double value : values) text << " " << value;
  return text.str();
}

/// An elastic block in a box of fluid, open at the top, on a pin that goes round in a circle.
mesh::Mesh block_on_pin() {
  const auto farthest = [](const std::array<double, 2>& x) {
    return std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5));
  };
  Parts parts;
  parts.regions = {"fluid", "block"};
  parts.region_at = [=](const std::array<double, 2>& x) {
    return farthest(x) < 0.06 ? -1 : farthest(x) < 0.19 ? 1 : 0;
  };
  parts.groups = {"pin", "top"};
  parts.group_at = [=](const std::array<double, 2>& x) { return farthest(x) < 0.1 ? 0 : x[1] < 1 ? -1 : 1; };
  return box_of_parts({1, 1}, {16, 16}, parts);
}

/// Smallest qualities of the mesh of the fluid at the end of each period; the pin gets its speed in the first.
std::vector<double> qualities_in_flow(Smoother smoother, int periods) {
  const mesh::Mesh mesh = block_on_pin();
  FlowSettings settings;
  settings.density = 1;
  settings.viscosity = 1;
  settings.boundaries = {boundary("pin", FlowBoundaryKind::velocity), boundary("top", FlowBoundaryKind::outlet)};
  settings.solids.emplace_back().region = "block";
  settings.solids[0].density = 1;
  settings.solids[0].young_modulus = 1e4;
  settings.smoother = smoother;
  settings.smoother_quality = 1;
  Prescribed prescribed;
  prescribed.velocity = [](const Point&, double t) -> Point {
    const double speed = 0.12 * 2 * pi * (t < 1 ? 0.5 * (1 - std::cos(pi * t)) : 1.0);
    return {speed * std::cos(2 * pi * t), speed * std::sin(2 * pi * t), 0};
  };
  FsiSolver solver(mesh, settings, {.scheme = TimeScheme::bdf2}, prescribed);
  std::vector<double> result;
  for (int period = 0; period < periods; ++period) {
    const StepReport report = run(solver, 1.0 / steps, steps);
    INFO(report.reason);
    REQUIRE_ON_ALL_RANKS(report.converged);
    result.push_back(smallest_quality(solver));
  }
  return result;
}

}  // namespace

TEST_CASE("a mesh that is smoothed from where it was drifts until it inverts") {
  const std::vector<double> qualities = qualities_of_accumulating(6);
  INFO("qualities after periods" << listed(qualities));
  CHECK(qualities.front() > 0.3);
  CHECK(qualities[3] < 0.5 * qualities.front());
  CHECK(qualities.back() < 0);
}

TEST_CASE("a mesh that is smoothed from its reference comes back in every period") {
  for (const Smoother smoother : {Smoother::linear, Smoother::nonlinear}) {
    const std::vector<double> qualities = qualities_of(smoother, 6);
    INFO("qualities after periods" << listed(qualities));
    CHECK(qualities.front() > 0.3);
    for (const double quality : qualities) CHECK(quality == Approx(qualities.front()).epsilon(1e-6));
  }
}

TEST_CASE("the mesh around a block that swings in a fluid comes back in every period", "[serial]") {
  for (const Smoother smoother : {Smoother::linear, Smoother::nonlinear}) {
    const std::vector<double> qualities = qualities_in_flow(smoother, 6);
    INFO("qualities after periods" << listed(qualities));
    CHECK(qualities.back() < 0.7);
    for (std::size_t i = 1; i < qualities.size(); ++i) CHECK(qualities[i] == Approx(qualities.back()).epsilon(1e-4));
  }
}

}  // namespace vocalis::fsi
