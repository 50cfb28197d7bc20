#include "core/fem/facet_integrals.hpp"

#include <algorithm>
#include <functional>

#include "core/fem/cell_map.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::fem;

namespace {

/// A box [0, 2] x [0, 1] whose facets on x = 1 are a group "middle", bent by (x, y) -> (x, y + bend x²).
struct Plane {
  mesh::Mesh mesh;
  fem::Space space;
  std::vector<double> points;

  Plane(int degree, double bend) : mesh(mesh::distribute(MPI_COMM_WORLD, whole())), space(fem::lagrange(mesh, degree)) {
    points = fem::dof_points(space);
    for (std::size_t i = 0; i < points.size(); i += 2) points[i + 1] += bend * points[i] * points[i];
  }
  static mesh::WholeMesh whole() {
    mesh::WholeMesh result = mesh::box(MPI_COMM_WORLD, {2, 1, 0}, {4, 5, 0});
    result.group_names.push_back("middle");
    std::vector<std::pair<double, std::int64_t>> middle;  // by y
    for (std::size_t v = 0; 2 * v < result.coordinates.size(); ++v) {
      if (result.coordinates[2 * v] == 1) middle.emplace_back(result.coordinates[2 * v + 1], v);
    }
    std::sort(middle.begin(), middle.end());
    for (std::size_t i = 1; i < middle.size(); ++i) {
      result.facet_vertices.insert(result.facet_vertices.end(), {middle[i - 1].second, middle[i].second});
      result.facet_group.push_back(static_cast<std::int32_t>(result.group_names.size()) - 1);
    }
    return result;
  }
  double flux(const std::string& group, const std::function<Point(double, double)>& velocity) const {
    fem::Field field(space, 2);
    for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
      const Point value = velocity(points[2 * dof], points[2 * dof + 1]);
      field.at(dof)[0] = value[0], field.at(dof)[1] = value[1];
    }
    return flux_through(field, points, facets_seen_once(mesh, group));
  }
};

}  // namespace

TEST_CASE("a group inside the mesh is crossed once, towards larger x") {
  for (const int degree : {1, 2}) {
    const Plane plane(degree, 0);
    CHECK(plane.flux("middle", [](double x, double y) { return Point{x + y, -2, 0}; }) == Approx(1.5));
    const auto facets = facets_seen_once(plane.mesh, "middle");
    std::int64_t count = 0, here = static_cast<std::int64_t>(facets.size());
    MPI_Allreduce(&here, &count, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
    CHECK(count == 5);
  }
}

TEST_CASE("a parabola of degree 2 flows exactly through straight and bent facets") {
  const Plane straight(2, 0), bent(2, 0.1);
  CHECK(straight.flux("right", [](double, double y) { return Point{6 * y * (1 - y), 0, 0}; }) == Approx(1));
  CHECK(straight.flux("left", [](double, double y) { return Point{6 * y * (1 - y), 0, 0}; }) == Approx(-1));
  // On the bottom, y = 0.1 x², n ds = (0.2 x, -1) dx: ∫ 0.2 x² - 0.1 x² dx
  CHECK(bent.flux("bottom", [](double x, double y) { return Point{x, y, 0}; }) == Approx(0.8 / 3));
}

TEST_CASE("the middles of edges bound a gap, too") {
  Plane plane(2, 0);
  const auto top = facets_seen_once(plane.mesh, "top");
  CHECK(gap_to_plane(plane.space, plane.points, top, 1, 0.2) == Approx(0.8));
  for (std::int32_t dof = 0; dof < plane.space.num_dofs(); ++dof) {
    if (plane.space.dof_vertex[dof] < 0) plane.points[2 * dof + 1] -= 0.01;
  }
  CHECK(gap_to_plane(plane.space, plane.points, top, 1, 0.2) == Approx(0.79));
}
