#include <catch2/catch.hpp>
#include <cmath>

#include "contact/axis_gap.hpp"
#include "contact/eikonal.hpp"
#include "contact/walls.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/contact/scenes.hpp"

namespace vocalis::contact {
namespace {

constexpr double kGamma = 0.5;

AxisGap gaps_of(const SceneMesh& built, std::span<const SymmetryPlane> planes, bool by_equation) {
  const fem::Space space = built.space();
  const auto& points = built.mesh.coordinates;
  if (!by_equation) return axis_gap(direct_distance(space, built.walls, points, planes, 1e9), points, kGamma);
  Eikonal eikonal(space);
  EikonalReport report;
  const auto walls = eikonal_distance(eikonal, space, built.walls, points, planes, {}, {}, report);
  REQUIRE(report.converged);
  return axis_gap(walls, points, kGamma);
}

struct Marked {
  mesh::Mesh mesh;
  std::vector<char> on_axis;
};

struct BoxScene {
  std::array<double, 3> size;
  std::array<int, 3> cells;
  std::vector<std::string> walls;
  void (*place)(int d, double* x) = [](int, double*) {};
  std::vector<SymmetryPlane> planes = {};
};

Marked axis_of(const Scene& scene, int dimension, int refinement, bool by_equation,
               std::span<const SymmetryPlane> planes = {}) {
  SceneMesh built = build(scene, dimension, refinement);
  const AxisGap gaps = gaps_of(built, planes, by_equation);
  std::vector<char> on_axis;
  for (const double gap : gaps.gap) on_axis.push_back(std::isfinite(gap));
  return {std::move(built.mesh), std::move(on_axis)};
}

Marked axis_of(const BoxScene& box, bool by_equation) {
  Scene scene{"box", box.size, box.cells, box.walls, nullptr};
  scene.place = box.place;
  return axis_of(scene, box.size[2] > 0 ? 3 : 2, 1, by_equation, box.planes);
}

struct Extent {
  int cells = 0;
  double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;  ///< of the middles of marked cells
};

Extent extent_of(const Marked& marked) {
  Extent extent;
  const mesh::Mesh& mesh = marked.mesh;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!marked.on_axis[cell]) continue;
    double x = 0, y = 0;
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      x += mesh.point(v)[0] / (mesh.dimension + 1);
      y += mesh.point(v)[1] / (mesh.dimension + 1);
    }
    ++extent.cells;
    extent.low_x = std::min(extent.low_x, x);
    extent.high_x = std::max(extent.high_x, x);
    extent.low_y = std::min(extent.low_y, y);
    extent.high_y = std::max(extent.high_y, y);
  }
  extent.cells = base::sum(mesh.comm, extent.cells);
  extent.low_x = base::smallest(mesh.comm, extent.low_x);
  extent.high_x = base::largest(mesh.comm, extent.high_x);
  extent.low_y = base::smallest(mesh.comm, extent.low_y);
  extent.high_y = base::largest(mesh.comm, extent.high_y);
  return extent;
}

TEST_CASE("The medial axis of a channel is its centre line, however many cells lie across") {
  const bool by_equation = GENERATE(false, true);
  for (const int across : {1, 2, 3, 4, 5, 8}) {
    const Extent extent = extent_of(axis_of({{1, 0.1 * across, 0}, {10, across, 0}, {"bottom", "top"}}, by_equation));
    INFO(across << " cells across");
    CHECK(extent.cells >= 10);
    CHECK(std::abs(extent.low_y - 0.05 * across) < (by_equation ? 0.2 : 0.101));
    CHECK(std::abs(extent.high_y - 0.05 * across) < (by_equation ? 0.2 : 0.101));
  }
  const Extent space = extent_of(axis_of({{0.6, 0.5, 0.6}, {6, 5, 6}, {"bottom", "top"}}, by_equation));
  CHECK(space.cells >= 100);
  CHECK(std::abs(space.low_y - 0.25) < (by_equation ? 0.2 : 0.101));
  CHECK(std::abs(space.high_y - 0.25) < (by_equation ? 0.2 : 0.101));
}

TEST_CASE("Corners of one wall are not on the axis") {
  const bool by_equation = GENERATE(false, true);
  const Extent extent = extent_of(axis_of({{2, 1, 0}, {20, 10, 0}, {"left", "right", "bottom", "top"}}, by_equation));
  CHECK(extent.cells >= 20);
  CHECK(extent.low_x > 0.35);
  CHECK(extent.high_x < 1.65);
  CHECK(extent.low_y > 0.38);
  CHECK(extent.high_y < 0.62);
}

/// Half the angle of this wedge is arctan 1/4, and that of the half one: sine 0.24 < γ.
void narrow_wedge(int, double* x) { x[1] = 0.5 * (x[0] + 0.1) * (x[1] - 0.5); }
void narrow_half_wedge(int, double* x) { x[1] = 0.25 * (x[0] + 0.1) * x[1]; }
/// Arctan 4/5: sine 0.62 > γ.
void wide_half_wedge(int, double* x) { x[1] = 0.8 * (x[0] + 0.1) * x[1]; }

TEST_CASE("The axis of a wedge is its bisector down to the apex") {
  const bool by_equation = GENERATE(false, true);
  const Extent extent = extent_of(axis_of({{2, 1, 0}, {20, 10, 0}, {"bottom", "top"}, narrow_wedge}, by_equation));
  CHECK(extent.low_x < 0.1);
  CHECK(extent.high_x > 1.9);
  CHECK(extent.low_y > -0.12);
  CHECK(extent.high_y < 0.12);
}

TEST_CASE("A plane of symmetry is the axis of half a channel and of half a narrow wedge") {
  const bool by_equation = GENERATE(false, true);
  const std::vector<SymmetryPlane> plane = {{1, 0}};
  for (const int across : {1, 2, 5}) {
    const Extent half =
        extent_of(axis_of({{1, 0.1 * across, 0}, {10, across, 0}, {"top"}, [](int, double*) {}, plane}, by_equation));
    INFO(across << " cells across");
    CHECK(half.cells >= 20);
    CHECK(half.high_y < 0.1);
    CHECK(half.low_x < 0.1);
    CHECK(half.high_x > 0.9);
  }
  const Extent space =
      extent_of(axis_of({{0.4, 0.4, 0.4}, {4, 4, 4}, {"top"}, [](int, double*) {}, plane}, by_equation));
  CHECK(space.cells >= 16 * 6);
  CHECK(space.high_y < 0.1);
  const Extent wedge = extent_of(axis_of({{2, 1, 0}, {20, 5, 0}, {"top"}, narrow_half_wedge, plane}, by_equation));
  CHECK(wedge.cells >= 40);
  CHECK(wedge.low_x < 0.1);
  CHECK(wedge.high_x > 1.9);
  CHECK(wedge.high_y < 0.1);
  // Only between the end of the wide wedge's wall and its mirror image, where they face each other.
  const Extent wide = extent_of(axis_of({{2, 1, 0}, {20, 10, 0}, {"top"}, wide_half_wedge, plane}, by_equation));
  CHECK(wide.high_x < 0.15);
}

TEST_CASE("A wall at a right angle to a plane of symmetry makes no contact") {
  const bool by_equation = GENERATE(false, true);
  const std::vector<SymmetryPlane> plane = {{1, 0}};
  const Extent end = extent_of(axis_of({{1, 0.5, 0}, {10, 5, 0}, {"left"}, [](int, double*) {}, plane}, by_equation));
  CHECK(end.cells == 0);
  // Half a channel with a closed end: at the plane, only what is further from the end than from the top.
  const Extent closed =
      extent_of(axis_of({{2, 0.5, 0}, {20, 5, 0}, {"left", "top"}, [](int, double*) {}, plane}, by_equation));
  CHECK(closed.cells >= 20);
  CHECK(closed.low_x > 0.35);
  CHECK(closed.high_x > 1.9);
  CHECK(closed.high_y < 0.2);
}

/// How far the marked cells' middles are from the bisector of a wedge's angle, over a cell's length.
template <int kSlopeInTenths>
double farthest_from_bisector(int dimension, int refinement, bool by_equation, int* cells) {
  const Marked marked = axis_of(wedge_scene<kSlopeInTenths>, dimension, refinement, by_equation);
  const double half = 0.5 * std::atan(kSlopeInTenths / 10.0);
  double farthest = 0;
  *cells = 0;
  for (std::int32_t cell = 0; cell < marked.mesh.num_cells(); ++cell) {
    if (!marked.on_axis[cell]) continue;
    ++*cells;
    double offset = 0;
    for (const std::int32_t v : marked.mesh.vertices_of(cell)) {
      const double* x = marked.mesh.point(v);
      offset += (x[1] * std::cos(half) - x[0] * std::sin(half)) / (dimension + 1);
    }
    farthest = std::max(farthest, std::abs(offset));
  }
  *cells = base::sum(marked.mesh.comm, *cells);
  return base::largest(marked.mesh.comm, farthest) * 4 * refinement;
}

TEST_CASE("In the corner of a sharp wedge only cells of its bisector are on the axis, of a wide one none") {
  const bool by_equation = GENERATE(false, true);
  for (const int dimension : {2, 3}) {
    const int refinement = dimension == 2 ? 8 : 3;
    int cells = 0;
    INFO("in " << dimension << " dimensions");
    CHECK(farthest_from_bisector<5>(dimension, refinement, by_equation, &cells) < (by_equation ? 2 : 1));
    CHECK(cells >= 4 * refinement);
    farthest_from_bisector<25>(dimension, refinement, by_equation, &cells);  // half the angle: 34 degrees, sine 0.56
    CHECK(cells == 0);
  }
}

TEST_CASE("The corner of a wall that points into the fluid is not on the axis, nor are those that close it off") {
  const bool by_equation = GENERATE(false, true);
  for (const int dimension : {2, 3}) {
    const int refinement = dimension == 2 ? 8 : 3;
    const Marked marked = axis_of(l_scene, dimension, refinement, by_equation);
    const double h = 1.0 / (4 * refinement);
    double nearest = 1, farthest = 0;
    for (std::int32_t cell = 0; cell < marked.mesh.num_cells(); ++cell) {
      if (!marked.on_axis[cell]) continue;
      double x = 0, y = 0;
      for (const std::int32_t v : marked.mesh.vertices_of(cell)) {
        x += marked.mesh.point(v)[0] / (dimension + 1);
        y += marked.mesh.point(v)[1] / (dimension + 1);
      }
      nearest = std::min(nearest, l_scene.distance(dimension, std::array<double, 3>{x, y, 0}.data()));
      farthest = std::max(farthest, x > 0.5 ? std::abs(y - 0.25) : y > 0.5 ? std::abs(x - 0.25) : 0.0);
    }
    INFO("in " << dimension << " dimensions");
    CHECK(base::smallest(marked.mesh.comm, nearest) > 0.25 - (by_equation ? 2 : 1) * h);
    CHECK(base::largest(marked.mesh.comm, farthest) < (by_equation ? 2 : 1) * h);
  }
}

TEST_CASE("The gap between parallel walls is within a cell") {
  const bool by_equation = GENERATE(false, true);
  for (const double depth : {0.0, 0.4}) {
    for (const int across : {1, 2, 5}) {
      const Scene scene{"gap", {1, 0.1 * across, depth}, {10, across, 4}, {"bottom", "top"}, nullptr};
      const SceneMesh built = build(scene, depth > 0 ? 3 : 2, 1);
      double deviation = 0;
      int cells = 0;
      for (const double gap : gaps_of(built, {}, by_equation).gap) {
        if (!std::isfinite(gap)) continue;
        ++cells;
        deviation = std::max(deviation, std::abs(gap - 0.1 * across));
      }
      INFO(across << " cells across, depth " << depth);
      CHECK(base::sum(MPI_COMM_WORLD, cells) >= 10);
      CHECK(base::largest(MPI_COMM_WORLD, deviation) < (by_equation ? 0.1 : 1e-12));
    }
  }
}

}  // namespace
}  // namespace vocalis::contact
