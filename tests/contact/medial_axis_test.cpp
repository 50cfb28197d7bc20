#include "contact/medial_axis.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "contact/nearest_facet.hpp"
#include "contact/walls.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::contact {
namespace {

struct Scene {
  std::array<double, 3> size;
  std::array<int, 3> cells;
  std::vector<std::string> walls;             ///< groups of the box
  void (*place)(double* x) = [](double*) {};  ///< moves a point of the box
  std::vector<SymmetryPlane> planes = {};
};

struct Marked {
  mesh::Mesh mesh;
  std::vector<char> on_axis;
};

Marked axis_of(const Scene& scene, bool by_equation, double gamma = 0.5) {
  Marked result{mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, scene.size, scene.cells)), {}};
  mesh::Mesh& mesh = result.mesh;
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += mesh.dimension) scene.place(&mesh.coordinates[i]);
  std::vector<std::int32_t> groups;
  for (const auto& name : scene.walls) groups.push_back(mesh::index_of(mesh.group_names, name));
  const std::vector<char> fluid(mesh.cells.num_local(), 1);
  const auto facets = wall_facets(mesh, fluid, groups);
  const fem::Space space = fem::lagrange(mesh, 1);
  if (by_equation) {
    Eikonal eikonal(space);
    EikonalReport report;
    const auto away = eikonal_distance(eikonal, space, facets, mesh.coordinates, scene.planes, {}, {}, report);
    REQUIRE(report.converged);
    result.on_axis = medial_axis(away, gamma);
  } else {
    result.on_axis = medial_axis(direct_distance(space, facets, mesh.coordinates, scene.planes, 1e9), gamma);
  }
  return result;
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
void narrow_wedge(double* x) { x[1] = 0.5 * (x[0] + 0.1) * (x[1] - 0.5); }
void narrow_half_wedge(double* x) { x[1] = 0.25 * (x[0] + 0.1) * x[1]; }
/// Arctan 4/5: sine 0.62 > γ.
void wide_half_wedge(double* x) { x[1] = 0.8 * (x[0] + 0.1) * x[1]; }

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
        extent_of(axis_of({{1, 0.1 * across, 0}, {10, across, 0}, {"top"}, [](double*) {}, plane}, by_equation));
    INFO(across << " cells across");
    CHECK(half.cells >= 20);
    CHECK(half.high_y < 0.1);
    CHECK(half.low_x < 0.1);
    CHECK(half.high_x > 0.9);
  }
  const Extent space = extent_of(axis_of({{0.4, 0.4, 0.4}, {4, 4, 4}, {"top"}, [](double*) {}, plane}, by_equation));
  CHECK(space.cells >= 16 * 6);
  CHECK(space.high_y < 0.1);
  const Extent wedge = extent_of(axis_of({{2, 1, 0}, {20, 5, 0}, {"top"}, narrow_half_wedge, plane}, by_equation));
  CHECK(wedge.cells >= 40);
  CHECK(wedge.low_x < 0.1);
  CHECK(wedge.high_x > 1.9);
  CHECK(wedge.high_y < 0.1);
  // Only between the end of the wide wedge's wall and its mirror image, where they face each other.
  const Extent wide = extent_of(axis_of({{2, 1, 0}, {20, 10, 0}, {"top"}, wide_half_wedge, plane}, false));
  CHECK(wide.high_x < 0.15);
}

TEST_CASE("A wall at a right angle to a plane of symmetry makes no contact") {
  const bool by_equation = GENERATE(false, true);
  const std::vector<SymmetryPlane> plane = {{1, 0}};
  const Extent end = extent_of(axis_of({{1, 0.5, 0}, {10, 5, 0}, {"left"}, [](double*) {}, plane}, by_equation));
  CHECK(end.low_x > (by_equation ? 0.9 : 1.0));  // at an open boundary the equation halves the slope of the last cell
  // Half a channel with a closed end: at the plane, only what is further from the end than from the top.
  const Extent closed =
      extent_of(axis_of({{2, 0.5, 0}, {20, 5, 0}, {"left", "top"}, [](double*) {}, plane}, by_equation));
  CHECK(closed.cells >= 20);
  CHECK(closed.low_x > 0.35);
  CHECK(closed.high_x > 1.9);
  CHECK(closed.high_y < 0.2);
}

}  // namespace
}  // namespace vocalis::contact
