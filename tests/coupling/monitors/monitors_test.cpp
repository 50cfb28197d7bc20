#include "coupling/monitors/monitors.hpp"

#include "tests/all_ranks.hpp"
#include "tests/coupling/monitors/watched_flow.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using namespace vocalis::coupling::test;
using Catch::Matchers::Contains;

namespace {

/// A box [0, 2] x [0, 1] (x [0, 0.5]), solid in x > 1.
class Watched {
 public:
  Watched(int dimension, fsi::Elements elements) : watched_(dimension, 2, 1, {4, 3}, elements, {}, 1) {}

  /// Displacement and velocity as functions of the reference point.
  void set(const Vector& displacement, const Vector& velocity) {
    fsi::FsiSolver& flow = watched_.flow;
    fsi::State state = flow.state();
    watched_.at_each_point([&](std::int32_t dof, const fem::Point& point) {
      for (int k = 0; k < watched_.scene->parent.dimension; ++k) {
        state.displacement.at(dof)[k] = displacement(point)[k];
        state.velocity.at(dof)[k] = velocity(point)[k];
      }
    });
    for (std::int32_t dof = 0; dof < flow.pressure_space().num_dofs(); ++dof) {
      const double* x = watched_.scene->flow->mesh.point(flow.pressure_space().dof_vertex[dof]);
      state.pressure.at(dof)[0] = 3 + 2 * x[0] - x[1];
    }
    flow.set_state(state);
  }
  const fsi::FsiSolver& flow() const { return watched_.flow; }
  std::vector<double> values(const std::vector<MonitorSettings>& monitors) const {
    return Monitors(flow(), monitors).evaluate();
  }

 private:
  WatchedFlow watched_;
};

MonitorSettings monitor_of(MonitorKind kind, const std::string& name) {
  MonitorSettings settings;
  settings.kind = kind;
  settings.name = name;
  return settings;
}

MonitorSettings gap_of(const std::string& group, int axis, double plane, bool mirrored = false) {
  MonitorSettings settings = monitor_of(MonitorKind::gap, "gap_" + group + (mirrored ? "_twice" : ""));
  settings.group = group;
  settings.axis = axis;
  settings.plane = plane;
  settings.mirrored = mirrored;
  return settings;
}

MonitorSettings flux_of(const std::string& group, bool mirrored = false) {
  MonitorSettings settings = monitor_of(MonitorKind::flux, "flow_" + group);
  settings.group = group;
  settings.mirrored = mirrored;
  return settings;
}

MonitorSettings at(MonitorKind kind, const fem::Point& position, const fem::Point& other = {0, 0, 0}) {
  MonitorSettings settings = monitor_of(kind, "point");
  settings.position = position;
  settings.other = other;
  return settings;
}

}  // namespace

TEST_CASE("columns are named after monitors, with units") {
  const std::vector<MonitorSettings> settings = {gap_of("top", 1, 0), flux_of("right"),
                                                 at(MonitorKind::displacement, {0.1, 0.1, 0.1})};
  CHECK(Monitors(Watched(2, fsi::Elements::p1p1).flow(), settings).columns() ==
        std::vector<std::string>{"gap_top_m", "flow_right_m2_s", "point_x_m", "point_y_m"});
  CHECK(Monitors(Watched(3, fsi::Elements::p1p1).flow(), settings).columns() ==
        std::vector<std::string>{"gap_top_m", "flow_right_m3_s", "point_x_m", "point_y_m", "point_z_m"});
}

TEST_CASE("gap and flux are taken where the mesh is now, the same on every rank") {
  for (const int d : {2, 3}) {
    for (const fsi::Elements elements : both_elements) {
      Watched watched(d, elements);
      // x -> x, y -> 0.9 y - 0.05 x; velocity (1 + Y, -3, 2)
      watched.set(
          [](const fem::Point& x) {
            return fem::Point{0, -0.1 * x[1] - 0.05 * x[0], 0};
          },
          [](const fem::Point& x) {
            return fem::Point{1 + x[1], -3, 2};
          });
      const std::vector<double> values = watched.values({gap_of("top", 1, 0.25), gap_of("top", 1, 0.25, true),
                                                         flux_of("right"), flux_of("left", true), flux_of("bottom")});
      REQUIRE_ON_ALL_RANKS(values.size() == 5);
      const double depth = d == 2 ? 1 : 0.5;
      CHECK(values[0] == Approx(0.9 - 0.1 - 0.25));  // where x = 2
      CHECK(values[1] == Approx(2 * values[0]));
      CHECK(values[2] == Approx(0.9 * 1.5 * depth));       // ∫ (1 + Y) 0.9 dY, out of the box
      CHECK(values[3] == Approx(-2 * 0.9 * 1.5 * depth));  // into the box on the left, and twice
      CHECK(values[4] == Approx((6 - 0.05 * 2) * depth));  // n ds = (-0.05, -1) dx, velocity (1, -3)
    }
  }
}

TEST_CASE("the flux out of a bent box of degree 2 is what its divergence says") {
  for (const int d : {2, 3}) {
    Watched watched(d, fsi::Elements::p2p1);
    // The volume stays, for the determinant is 1; the velocity is the present position, its divergence d.
    const auto bend = [](const fem::Point& x) { return fem::Point{0, 0.1 * x[0] * x[0], 0}; };
    watched.set(bend, [&](const fem::Point& x) { return fem::Point{x[0], x[1] + bend(x)[1], x[2]}; });
    std::vector<MonitorSettings> sides = {flux_of("left"), flux_of("right"), flux_of("bottom"), flux_of("top")};
    if (d == 3) sides.insert(sides.end(), {flux_of("front"), flux_of("back")});
    double total = 0;
    for (const double value : watched.values(sides)) total += value;
    CHECK(total == Approx(d == 2 ? 4 : 3).epsilon(1e-12));
  }
}

TEST_CASE("the displacement of a point is that of its cell's polynomial") {
  for (const int d : {2, 3}) {
    for (const fsi::Elements elements : both_elements) {
      Watched watched(d, elements);
      const bool quadratic = elements == fsi::Elements::p2p1;
      const Vector displacement = [&](const fem::Point& x) {
        return fem::Point{0.1 * x[1], quadratic ? 0.05 * x[0] * x[1] - 0.1 * x[2] * x[2] : 0.2 * x[0], 0.1 * x[0]};
      };
      watched.set(displacement, rest);
      // In a cell, on the interface, in a corner
      for (const fem::Point& point : {fem::Point{0.37, 0.41, 0.13}, fem::Point{1, 0.5, 0.2}, fem::Point{2, 1, 0.5}}) {
        fem::Point here = point;
        if (d == 2) here[2] = 0;
        const std::vector<double> values = watched.values({at(MonitorKind::displacement, here)});
        REQUIRE_ON_ALL_RANKS(values.size() == static_cast<std::size_t>(d));
        for (int k = 0; k < d; ++k) CHECK(values[k] == Approx(displacement(here)[k]).margin(1e-12));
      }
    }
  }
}

TEST_CASE("pressures are the fluid's, at points that move with the mesh") {
  for (const fsi::Elements elements : both_elements) {
    Watched watched(2, elements);
    watched.set([](const fem::Point& x) { return fem::Point{0.3 * x[0], 0.1 * x[1], 0}; }, rest);
    MonitorSettings fall = at(MonitorKind::pressure_difference, {0.9, 0.2, 0}, {0.1, 0.7, 0});
    fall.name = "fall";
    const std::vector<double> values = watched.values({at(MonitorKind::pressure, {1, 0.5, 0}), fall});
    REQUIRE_ON_ALL_RANKS(values.size() == 2);
    CHECK(values[0] == Approx(3 + 2 - 0.5));
    CHECK(values[1] == Approx(2 * 0.8 + 0.5));
  }
}

TEST_CASE("a flux across a line ends where the solid begins") {
  for (const fsi::Elements elements : both_elements) {
    Watched watched(2, elements);
    watched.set(rest, [](const fem::Point& x) { return fem::Point{0, 1 + x[0], 0}; });
    MonitorSettings line = monitor_of(MonitorKind::flux, "across");
    line.from = {1.5, 0.4, 0};
    line.to = {-0.5, 0.4, 0};
    CHECK(watched.values({line})[0] == Approx(1.5));  // upwards is to the right of the way to smaller x
  }
}

TEST_CASE("the gap is a distance, on either side of the plane") {
  Watched watched(2, fsi::Elements::p1p1);
  const std::vector<double> values = watched.values({gap_of("bottom", 1, 0.3), gap_of("left", 0, -0.1)});
  CHECK(values[0] == Approx(0.3));
  CHECK(values[1] == Approx(0.1));
}

TEST_CASE("a force has the components of the fluid's reaction, or is a coefficient") {
  auto scene = box_scene({2, 1, 0}, {4, 3, 0}, [](const fem::Point&) { return RegionKind::fluid; });
  for (const fsi::Elements elements : both_elements) {
    fsi::FlowSettings settings;
    settings.elements = elements;
    settings.viscosity = 0.1;
    settings.boundaries = {{.group = "left", .kind = fsi::FlowBoundaryKind::velocity, .velocity = {1, 0, 0}},
                           {.group = "right", .kind = fsi::FlowBoundaryKind::outlet}};
    fsi::FsiSolver flow(scene->flow->mesh, settings, {.end = 1, .step = 0.1});
    MonitorSettings force = monitor_of(MonitorKind::force, "");
    force.groups = {"top", "bottom"};
    MonitorSettings coefficient = force;
    coefficient.name = "walls";
    coefficient.reference_force = 0.25;
    Monitors monitors(flow, {force, coefficient});
    CHECK(monitors.columns() ==
          std::vector<std::string>{"drag_N", "lift_N", "walls_drag_coefficient", "walls_lift_coefficient"});
    REQUIRE_ON_ALL_RANKS(flow.try_step(0.1).converged);
    flow.accept();
    monitors.follow_step();
    const std::vector<double> values = monitors.evaluate();
    REQUIRE_ON_ALL_RANKS(values.size() == 4);
    const auto wanted = fsi::force_on(flow, fsi::make_body(flow, force.groups));
    CHECK(std::abs(values[0]) > 0.1);
    CHECK(values[0] == Approx(wanted[0]));
    CHECK(values[1] == Approx(wanted[1]));
    CHECK(values[2] == Approx(4 * wanted[0]));
    CHECK(values[3] == Approx(4 * wanted[1]));
  }
}

TEST_CASE("what the flow's mesh lacks is refused") {
  const Watched watched(2, fsi::Elements::p1p1), in_space(3, fsi::Elements::p1p1);
  const auto message = [](const Watched& of, const std::vector<MonitorSettings>& monitors) {
    return message_of([&] { Monitors(of.flow(), monitors); });
  };
  CHECK_THAT(message(watched, {flux_of("rigth")}), Contains("did you mean \"right\""));
  CHECK_THAT(message(watched, {gap_of("front", 1, 0)}), Contains("group of facets on the flow mesh"));
  CHECK_THAT(message(watched, {at(MonitorKind::displacement, {2.3, 0.5, 0})}), Contains("inside the fluid or a solid"));
  CHECK_THAT(message(watched, {at(MonitorKind::pressure, {1.5, 0.5, 0})}), Contains("inside the fluid"));
  CHECK_THAT(message(watched, {at(MonitorKind::pressure_difference, {0.5, 0.5, 0}, {1.5, 0.5, 0})}),
             Contains("[1.5, 0.5]"));
  CHECK_THAT(message(in_space, {monitor_of(MonitorKind::flux, "line")}), Contains("in the plane only"));
  MonitorSettings force = monitor_of(MonitorKind::force, "");
  force.groups = {"left", "rigth"};
  CHECK_THAT(message(watched, {force}), Contains("did you mean \"right\""));
  MonitorSettings twin = gap_of("top", 1, 0);
  twin.name = "point_x";
  CHECK_THAT(message(watched, {twin, at(MonitorKind::displacement, {0.5, 0.5, 0})}), Contains("\"point_x_m\" twice"));
}
