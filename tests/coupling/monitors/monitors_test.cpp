#include "coupling/monitors/monitors.hpp"

#include "core/base/error.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

mesh::Mesh box(int dimension) {
  const mesh::WholeMesh whole = dimension == 2 ? mesh::box(MPI_COMM_WORLD, {2, 1, 0}, {4, 3, 0})
                                               : mesh::box(MPI_COMM_WORLD, {2, 1, 0.5}, {4, 3, 2});
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

MonitorSettings gap_of(const std::string& group, int axis, double plane, bool mirrored) {
  MonitorSettings settings;
  settings.name = "gap";
  settings.group = group;
  settings.axis = axis;
  settings.plane = plane;
  settings.mirrored = mirrored;
  return settings;
}

MonitorSettings flux_of(const std::string& group, bool mirrored) {
  MonitorSettings settings;
  settings.name = "flow";
  settings.kind = MonitorKind::flux;
  settings.group = group;
  settings.mirrored = mirrored;
  return settings;
}

MonitorSettings displacement_of(const std::array<double, 3>& position) {
  MonitorSettings settings;
  settings.name = "tip";
  settings.kind = MonitorKind::displacement;
  settings.position = position;
  return settings;
}

}  // namespace

TEST_CASE("columns are named after monitors, with units") {
  const std::vector<MonitorSettings> settings = {gap_of("top", 1, 0, false), flux_of("right", false),
                                                 displacement_of({0, 0, 0})};
  const mesh::Mesh plane = box(2), solid = box(3);
  CHECK(Monitors(plane, settings).columns() == std::vector<std::string>{"gap_m", "flow_m2_s", "tip_x_m", "tip_y_m"});
  CHECK(Monitors(solid, settings).columns() ==
        std::vector<std::string>{"gap_m", "flow_m3_s", "tip_x_m", "tip_y_m", "tip_z_m"});
}

TEST_CASE("gap, flux and displacement are the same numbers on every rank") {
  for (const int d : {2, 3}) {
    const mesh::Mesh mesh = box(d);
    const Monitors monitors(mesh, {gap_of("top", 1, 0.25, false), gap_of("top", 1, 0.25, true), flux_of("right", false),
                                   flux_of("left", true), displacement_of({1.9, 0.9, 0.6})});
    // Coordinates pressed together: x -> x, y -> 0.9 y - 0.05 x; velocity (1 + y, -3, 2).
    std::vector<double> coordinates = mesh.coordinates, velocity;
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      double* point = coordinates.data() + static_cast<std::size_t>(v) * d;
      point[1] = 0.9 * point[1] - 0.05 * point[0];
      const double components[] = {1 + mesh.point(v)[1], -3, 2};
      velocity.insert(velocity.end(), components, components + d);
    }
    const std::vector<double> values = monitors.evaluate({coordinates, velocity});
    REQUIRE_ON_ALL_RANKS(values.size() == static_cast<std::size_t>(4 + d));
    const double depth = d == 2 ? 1 : 0.5;
    CHECK(values[0] == Approx(0.9 - 0.1 - 0.25));  // where x = 2
    CHECK(values[1] == Approx(2 * values[0]));
    CHECK(values[2] == Approx(1.5 * depth));   // ∫ (1 + y) dy, out of the box
    CHECK(values[3] == Approx(-3.0 * depth));  // into the box on the left, and twice
    CHECK(values[4] == Approx(0).margin(1e-14));
    CHECK(values[5] == Approx(-0.2));  // of the corner (2, 1), the vertex nearest to the point
    if (d == 3) CHECK(values[6] == Approx(0).margin(1e-14));
  }
}

TEST_CASE("the gap is a distance, on either side of the plane") {
  const mesh::Mesh mesh = box(2);
  const Monitors monitors(mesh, {gap_of("bottom", 1, 0.3, false), gap_of("left", 0, -0.1, false)});
  const std::vector<double> velocity(mesh.coordinates.size(), 0.0);
  const std::vector<double> values = monitors.evaluate({mesh.coordinates, velocity});
  CHECK(values[0] == Approx(0.3));
  CHECK(values[1] == Approx(0.1));
}

TEST_CASE("a group that the flow's mesh lacks is refused") {
  const mesh::Mesh mesh = box(2);
  CHECK_THROWS_AS(Monitors(mesh, {flux_of("rigth", false)}), base::UserError);
  CHECK_THROWS_AS(Monitors(mesh, {gap_of("front", 1, 0, false)}), base::UserError);
}
