#include "coupling/monitors/glottis.hpp"

#include <cmath>

#include "coupling/monitors/monitors.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/monitors/watched_flow.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using namespace vocalis::coupling::test;
using Catch::Matchers::Contains;

namespace {

constexpr double dt = 0.1;

/// Air in a box [0, 2] x [0, 1] (x [0, 0.5]) whose sides are the folds, and a solid behind it, in 2 < x < 2.5, which
/// has parts of the sides, too.
class Plates {
 public:
  Plates(int dimension, fsi::Elements elements)
      : watched_(dimension, 2.5, 2, {5, 4}, elements, fsi::ContactMedium{.young_modulus = 1e4}, dt) {}

  /// Displacement, and velocities of fluid and mesh, of the reference point.
  void set(const Vector& displacement, const fem::Point& velocity = {}, const fem::Point& mesh_velocity = {}) {
    fsi::State state = watched_.flow.state();
    watched_.at_each_point([&](std::int32_t dof, const fem::Point& point) {
      for (int k = 0; k < watched_.scene->parent.dimension; ++k) {
        state.displacement.at(dof)[k] = displacement(point)[k];
        state.displacement_before.at(dof)[k] = displacement(point)[k] - dt * mesh_velocity[k];
        state.velocity.at(dof)[k] = 1.5 * velocity[k];
        state.velocity_before.at(dof)[k] = 0.5 * velocity[k];
      }
    });
    state.last_dt = dt;
    watched_.flow.set_state(state);
  }
  /// Makes the cells with their centres in there contact cells.
  void close(const std::function<bool(const fem::Point&)>& is_inside) {
    const mesh::Mesh& mesh = watched_.scene->flow->mesh;
    std::vector<char> marks(mesh.num_cells());
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      fem::Point centre = {0, 0, 0};
      for (const std::int32_t v : mesh.vertices_of(cell)) {
        for (int k = 0; k < mesh.dimension; ++k) centre[k] += mesh.point(v)[k] / (mesh.dimension + 1);
      }
      marks[cell] = is_inside(centre);
    }
    watched_.flow.set_contact(marks);
  }
  GlottalOpening opening(const MonitorSettings& settings) const {
    const Monitors monitors(watched_.flow, {settings});
    return monitors.opening(*monitors.glottises().at(0));
  }
  std::vector<double> values(const MonitorSettings& settings) const {
    return Monitors(watched_.flow, {settings}).evaluate();
  }
  std::vector<std::string> columns(const MonitorSettings& settings) const {
    return Monitors(watched_.flow, {settings}).columns();
  }

 private:
  WatchedFlow watched_;
};

MonitorSettings glottis_of(const std::string& group, const std::string& other) {
  MonitorSettings settings;
  settings.kind = MonitorKind::glottis;
  settings.name = "glottis";
  settings.group = group;
  settings.other_group = other;
  settings.stations = 20;
  settings.span_stations = 8;
  return settings;
}

MonitorSettings half_of(const std::string& group, double plane) {
  MonitorSettings settings = glottis_of(group, "");
  settings.plane = plane;
  settings.mirrored = true;
  return settings;
}

/// The plates y = 0 and y = 1 come together by 0.1 + 0.15 x (and 0.2 z).
const Vector wedge = [](const fem::Point& x) {
  return fem::Point{0, (1 - x[1]) * 0.05 * x[0] - x[1] * (0.1 + 0.1 * x[0] + 0.2 * x[2]), 0};
};

}  // namespace

TEST_CASE("between two plates the opening is their distance at each station, whichever is named first") {
  for (const fsi::Elements elements : both_elements) {
    Plates plates(2, elements);
    plates.set(wedge);
    for (const MonitorSettings& settings : {glottis_of("top", "bottom"), glottis_of("bottom", "top")}) {
      const GlottalOpening opening = plates.opening(settings);
      REQUIRE_ON_ALL_RANKS(opening.areas.size() == 20);
      for (int i = 0; i < 20; ++i) CHECK(opening.areas[i] == Approx(0.9 - 0.15 * (0.05 + 0.1 * i)));
      CHECK(opening.narrowest == 19);
      CHECK(opening.gap == Approx(0.9 - 0.15 * 1.95));
      CHECK(opening.low == Approx(0.05 * 1.95));
      CHECK(opening.high == Approx(0.9 - 0.1 * 1.95));
    }
  }
}

TEST_CASE("a curved plate is followed through the middles of its edges") {
  Plates plates(2, fsi::Elements::p2p1);
  plates.set([](const fem::Point& x) { return fem::Point{0, -0.3 * x[1] * x[0] * (2 - x[0]), 0}; });
  MonitorSettings settings = half_of("top", -0.5);
  settings.stations = 4;  // 0.25, 0.75, ...: where the middles are
  const GlottalOpening opening = plates.opening(settings);
  REQUIRE_ON_ALL_RANKS(opening.areas.size() == 4);
  for (int i = 0; i < 4; ++i) {
    const double x = 0.25 + 0.5 * i;
    CHECK(opening.areas[i] == Approx(2 * (1.5 - 0.3 * x * (2 - x))));
  }
}

TEST_CASE("half a glottis counts twice, and may lie on either side of its plane") {
  Plates plates(2, fsi::Elements::p1p1);
  plates.set(wedge);
  CHECK(plates.opening(half_of("top", 0.25)).gap == Approx(2 * (0.9 - 0.1 * 1.95 - 0.25)));
  CHECK(plates.opening(half_of("bottom", 0.25)).gap == Approx(2 * (0.25 - 0.05 * 1.95)));
  MonitorSettings one_sided = half_of("top", 0.25);
  one_sided.mirrored = false;
  CHECK(plates.opening(one_sided).gap == Approx(0.9 - 0.1 * 1.95 - 0.25));
}

TEST_CASE("in space the area is the width integrated over the folds' length") {
  for (const fsi::Elements elements : both_elements) {
    Plates plates(3, elements);
    plates.set(wedge);
    const GlottalOpening opening = plates.opening(glottis_of("top", "bottom"));
    REQUIRE_ON_ALL_RANKS(opening.areas.size() == 20);
    for (int i = 0; i < 20; ++i) {
      CHECK(opening.areas[i] == Approx(0.5 * (0.9 - 0.15 * (0.05 + 0.1 * i)) - 0.2 * 0.125));
    }
    CHECK(opening.gap == Approx(0.9 - 0.15 * 1.95 - 0.2 * (0.5 - 0.03125)));
    CHECK(plates.columns(glottis_of("top", "bottom")) ==
          std::vector<std::string>{"glottis_gap_m", "glottis_area_m2", "glottis_speed_m_s", "glottis_impact_stress_Pa",
                                   "glottis_contact"});
  }
}

TEST_CASE("contact cells seal the stations where they touch both folds, or the one before its plane") {
  Plates plates(2, fsi::Elements::p2p1);
  plates.set(wedge);
  plates.close([](const fem::Point& x) { return x[0] > 0.5 && x[0] < 1.5 && x[1] > 0.5; });
  CHECK(plates.opening(glottis_of("top", "bottom")).gap > 0.5);
  const GlottalOpening half = plates.opening(half_of("top", 0.25));
  CHECK(half.gap == 0);
  CHECK(half.area == 0);
  for (int i = 0; i < 20; ++i) CHECK((half.areas[i] == 0) == (i >= 5 && i < 15));
  CHECK(half.narrowest == 9);
  CHECK(half.high == Approx(0.9 - 0.1 * 0.95));
  CHECK(plates.values(half_of("top", 0.25)).back() == 8);  // cells
  plates.close([](const fem::Point& x) { return x[0] > 0.5 && x[0] < 1.5; });
  CHECK(plates.opening(glottis_of("top", "bottom")).gap == 0);
  plates.close([](const fem::Point&) { return false; });
  CHECK(plates.opening(glottis_of("top", "bottom")).gap > 0.5);
}

TEST_CASE("in space a seal over half of the folds leaves the other half of the area") {
  Plates plates(3, fsi::Elements::p1p1);
  plates.set(rest);
  plates.close([](const fem::Point& x) { return x[0] > 0.5 && x[0] < 1 && x[2] < 0.25; });
  const GlottalOpening opening = plates.opening(glottis_of("top", "bottom"));
  CHECK(opening.gap == 0);
  CHECK(opening.area == Approx(0.25));
}

TEST_CASE("the flow past the folds is that relative to the mesh, per metre or of the folds' length") {
  for (const fsi::Elements elements : both_elements) {
    Plates plates(2, elements);
    plates.set(wedge, {2, 7, 0}, {0.5, -3, 0});
    MonitorSettings settings = glottis_of("top", "bottom");
    const double gap = 0.9 - 0.15 * 1.95;
    std::vector<double> values = plates.values(settings);
    REQUIRE_ON_ALL_RANKS(values.size() == 5);
    CHECK(plates.columns(settings) == std::vector<std::string>{"glottis_gap_m", "glottis_flow_m2_s",
                                                               "glottis_speed_m_s", "glottis_impact_stress_Pa",
                                                               "glottis_contact"});
    CHECK(values[0] == Approx(gap));
    CHECK(values[1] == Approx(1.5 * gap));
    CHECK(values[2] == Approx(1.5 * std::hypot(2, 7)));
    CHECK(values[3] == 0);
    CHECK(values[4] == 0);
    settings.depth = 0.3;
    values = plates.values(settings);
    REQUIRE_ON_ALL_RANKS(values.size() == 6);
    CHECK(plates.columns(settings)[1] == "glottis_area_m2");
    CHECK(plates.columns(settings)[2] == "glottis_flow_m3_s");
    CHECK(values[1] == Approx(0.3 * gap));
    CHECK(values[2] == Approx(0.3 * 1.5 * gap));
    settings = half_of("top", 0);
    CHECK(plates.values(settings)[1] == Approx(1.5 * 2 * (0.9 - 0.1 * 1.95 - 0.05 * 1.95)));  // the air ends at 0.05 x
  }
}

TEST_CASE("air may flow along y, between a fold on the left and a plane on its right") {
  Plates plates(2, fsi::Elements::p1p1);
  plates.set(rest, {7, 2, 0}, {5, 0.5, 0});
  MonitorSettings settings = half_of("left", 1.5);
  settings.axis = 0;
  settings.along = 1;
  const std::vector<double> values = plates.values(settings);
  REQUIRE_ON_ALL_RANKS(values.size() == 5);
  CHECK(values[0] == Approx(3));
  CHECK(values[1] == Approx(3 * 1.5));
}

TEST_CASE("the impact stress is what presses the folds together") {
  // A block of tissue lies on another through a sealed layer, and its own weight on it.
  auto scene = box_scene({1, 1, 0}, {4, 6, 0}, [](const fem::Point& centre) {
    return centre[1] < 1.0 / 3 ? RegionKind::fluid : RegionKind::solid;
  });
  for (const fsi::Elements elements : both_elements) {
    fsi::FlowSettings settings;
    settings.elements = elements;
    settings.gravity = {0, -10, 0};
    settings.solids = {{.region = "solid", .density = 1000, .young_modulus = 1e7, .poisson_ratio = 0, .damping = 1e4}};
    settings.contact = fsi::ContactMedium{.young_modulus = 1e7, .damping = 1e4};
    for (const char* side : {"left", "right", "bottom"}) {
      settings.boundaries.push_back({.group = side, .kind = fsi::FlowBoundaryKind::symmetry});
    }
    fsi::FsiSolver flow(scene->flow->mesh, settings, {.end = 1, .step = 0.01, .scheme = fsi::TimeScheme::bdf2});
    MonitorSettings sealed = half_of("bottom", 1);
    const Monitors monitors(flow, {sealed});
    std::vector<char> marks(scene->flow->mesh.num_cells());
    for (std::size_t cell = 0; cell < marks.size(); ++cell) marks[cell] = scene->flow->mesh.cell_region[cell] == 0;
    flow.set_contact(marks);
    for (int step = 0; step < 10; ++step) {
      const fsi::StepReport report = flow.try_step(0.01);
      INFO(step << ": " << report.reason);
      REQUIRE_ON_ALL_RANKS(report.converged);
      flow.accept();
    }
    const std::vector<double> values = monitors.evaluate();
    REQUIRE_ON_ALL_RANKS(values.size() == 5);
    CHECK(values[0] == 0);
    CHECK(std::abs(values[1]) < 1e-6);  // m^2/s: nothing passes a medium that goes with the mesh
    CHECK(values[3] == Approx(1000 * 10 * 2.0 / 3).epsilon(0.02));
  }
}

TEST_CASE("folds that the flow's mesh lacks, or that do not face each other, are refused") {
  const Plates plates(2, fsi::Elements::p1p1), in_space(3, fsi::Elements::p1p1);
  const auto message = [](const Plates& of, const MonitorSettings& settings) {
    return message_of([&] { of.columns(settings); });
  };
  CHECK_THAT(message(plates, glottis_of("topp", "bottom")), Contains("did you mean \"top\""));
  CHECK_THAT(message(plates, glottis_of("right", "bottom")), Contains("that the fluid touches"));
  CHECK_THAT(message(plates, glottis_of("top", "left")), Contains("face each other over some length of x"));
  MonitorSettings flat = half_of("top", 0);
  flat.axis = 2;
  CHECK_THAT(message(plates, flat), Contains("an axis of the mesh"));
  MonitorSettings deep = half_of("top", 0);
  deep.depth = 0.01;
  CHECK_THAT(message(in_space, deep), Contains("for plane meshes"));
}
