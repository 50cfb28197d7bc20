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

struct Marked {
  mesh::Mesh mesh;
  std::vector<char> on_axis;
};

/// The axis of a box whose points are moved, with walls at the named groups, from exact distances.
Marked axis_of(std::array<double, 3> size, std::array<int, 3> cells, const std::vector<std::string>& walls,
               double (*height)(double x), double gamma, bool by_equation) {
  Marked result{mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, size, cells)), {}};
  mesh::Mesh& mesh = result.mesh;
  const int d = mesh.dimension;
  for (std::size_t i = 0; i < mesh.coordinates.size(); i += d) {
    mesh.coordinates[i + 1] = (mesh.coordinates[i + 1] - 0.5 * size[1]) * height(mesh.coordinates[i]);
  }
  std::vector<std::int32_t> groups;
  for (const auto& name : walls) groups.push_back(mesh::index_of(mesh.group_names, name));
  const std::vector<char> fluid(mesh.cells.num_local(), 1);
  const auto facets = wall_facets(mesh, fluid, groups);
  const fem::Space space = fem::lagrange(mesh, 1);
  if (by_equation) {
    Eikonal eikonal(space);
    EikonalReport report;
    const auto walls_away = eikonal_distance(eikonal, space, facets, mesh.coordinates, {}, {}, report);
    REQUIRE(report.converged);
    result.on_axis = medial_axis(walls_away, gamma);
  } else {
    result.on_axis = medial_axis(direct_distance(space, facets, mesh.coordinates, {}, 1e9), gamma);
  }
  return result;
}

double unit(double) { return 1; }
double wedge(double x) { return 0.5 * x; }

struct Extent {
  int cells = 0;
  double low_x = 1e9, high_x = -1e9, furthest_y = 0;  ///< of the middles of marked cells
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
    extent.furthest_y = std::max(extent.furthest_y, std::abs(y));
  }
  extent.cells = base::sum(mesh.comm, extent.cells);
  extent.low_x = base::smallest(mesh.comm, extent.low_x);
  extent.high_x = base::largest(mesh.comm, extent.high_x);
  extent.furthest_y = base::largest(mesh.comm, extent.furthest_y);
  return extent;
}

TEST_CASE("The medial axis of a channel is its centre line, however many cells lie across") {
  const bool by_equation = GENERATE(false, true);
  for (const int across : {1, 2, 3, 4, 5, 8}) {
    const Extent extent =
        extent_of(axis_of({1, 0.1 * across, 0}, {10, across, 0}, {"bottom", "top"}, unit, 0.5, by_equation));
    INFO(across << " cells across");
    CHECK(extent.cells >= 10);
    CHECK(extent.furthest_y < (by_equation ? 0.2 : 0.101));
  }
  const Extent space = extent_of(axis_of({0.6, 0.5, 0.6}, {6, 5, 6}, {"bottom", "top"}, unit, 0.5, by_equation));
  CHECK(space.cells >= 100);
  CHECK(space.furthest_y < (by_equation ? 0.2 : 0.101));
}

TEST_CASE("Corners of one wall are not on the axis") {
  const bool by_equation = GENERATE(false, true);
  const Extent extent =
      extent_of(axis_of({2, 1, 0}, {20, 10, 0}, {"left", "right", "bottom", "top"}, unit, 0.5, by_equation));
  CHECK(extent.cells >= 20);
  CHECK(extent.low_x > 0.35);
  CHECK(extent.high_x < 1.65);
  CHECK(extent.furthest_y < 0.12);
}

TEST_CASE("The axis of a wedge is its bisector down to the apex") {
  const bool by_equation = GENERATE(false, true);
  const Extent extent = extent_of(axis_of(
      {2, 1, 0}, {20, 10, 0}, {"bottom", "top"}, [](double x) { return wedge(x + 0.1); }, 0.5, by_equation));
  CHECK(extent.low_x < 0.1);
  CHECK(extent.high_x > 1.9);
  CHECK(extent.furthest_y < 0.12);
}

}  // namespace
}  // namespace vocalis::contact
