#include <catch2/catch.hpp>
#include <cmath>

#include "contact/eikonal.hpp"
#include "contact/nearest_facet.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::contact {
namespace {

/// A channel 0 < y < 1 with walls at the bottom and the top.
mesh::Mesh channel(int dimension, int cells) {
  return mesh::distribute(
      MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {0.5, 1, dimension == 3 ? 0.5 : 0.0}, {cells / 2, cells, cells / 2}));
}

std::vector<std::int32_t> groups(const mesh::Mesh& mesh) {
  return {mesh::index_of(mesh.group_names, "bottom"), mesh::index_of(mesh.group_names, "top")};
}

double error_of_eikonal(int dimension, int cells, int* iterations = nullptr) {
  const mesh::Mesh mesh = channel(dimension, cells);
  const fem::Space space = fem::lagrange(mesh, 1);
  std::vector<mesh::NamedFacet> facets = mesh::facets_of_group(mesh, "bottom");
  for (const auto& facet : mesh::facets_of_group(mesh, "top")) facets.push_back(facet);
  const auto marks = mesh::mark_vertices(mesh, facets);
  const std::vector<char> is_zero(marks.begin(), marks.end());
  fem::Field distance(space, 1);
  const auto report = Eikonal(space).solve(mesh.coordinates, is_zero, {}, distance);
  REQUIRE(report.converged);
  if (iterations) *iterations = report.iterations;
  double error = 0;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double y = mesh.point(v)[1];
    error = std::max(error, std::abs(distance.values[v] - std::min(y, 1 - y)));
  }
  return base::largest(mesh.comm, error);
}

double distance_from_facet(int dimension, const double* corners, const double* point) {
  const Point nearest = nearest_of_facet(dimension, corners, point);
  return std::hypot(nearest[0] - point[0], nearest[1] - point[1], dimension == 3 ? nearest[2] - point[2] : 0.0);
}

TEST_CASE("The distance from facets is that of plane geometry") {
  const double segment[] = {0, 0, 2, 0};
  const double above[] = {1, 3}, beyond[] = {5, 4};
  CHECK(distance_from_facet(2, segment, above) == Approx(3));
  CHECK(distance_from_facet(2, segment, beyond) == Approx(5));
  const double triangle[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const double over[] = {0.2, 0.2, 2}, beside[] = {1, 1, 0}, corner[] = {-3, 0, 4};
  CHECK(distance_from_facet(3, triangle, over) == Approx(2));
  CHECK(distance_from_facet(3, triangle, beside) == Approx(std::sqrt(0.5)));
  CHECK(distance_from_facet(3, triangle, corner) == Approx(5));
}

TEST_CASE("The tree finds the nearest facet of all") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = channel(dimension, 8);
    const std::vector<char> fluid(mesh.cells.num_local(), 1);
    const Walls walls = gather_walls(mesh, wall_facets(mesh, fluid, groups(mesh)), mesh.coordinates);
    CHECK(walls.num_facets() == (dimension == 2 ? 8u : 64u));
    const NearestFacet tree(walls);
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      const double y = mesh.point(v)[1];
      const Nearest nearest = tree.find(mesh.point(v));
      CHECK(nearest.distance == Approx(std::min(y, 1 - y)).margin(1e-14));
      if (y != 0.5) CHECK(nearest.point[1] == (y < 0.5 ? 0 : 1));
      CHECK(tree.find(mesh.point(v), 0.2).facet == (std::min(y, 1 - y) < 0.2 ? nearest.facet : -1));
    }
  }
}

TEST_CASE("A plane of symmetry mirrors the walls") {
  const mesh::Mesh mesh = channel(2, 8);
  const std::vector<char> fluid(mesh.cells.num_local(), 1);
  const SymmetryPlane plane{1, 1.0};
  const Walls walls = gather_walls(mesh, wall_facets(mesh, fluid, {{groups(mesh)[0]}}), mesh.coordinates, {&plane, 1});
  const double point[] = {0.2, 1.9};
  const Nearest nearest = NearestFacet(walls).find(point);
  CHECK(nearest.distance == Approx(0.1));
  CHECK(nearest.point[1] == Approx(2));
}

TEST_CASE("The Eikonal equation converges to the distance at first order") {
  for (const int dimension : {2, 3}) {
    const double coarse = error_of_eikonal(dimension, dimension == 2 ? 16 : 8);
    const double fine = error_of_eikonal(dimension, dimension == 2 ? 32 : 16);
    INFO("dimension " << dimension << " errors " << coarse << " " << fine);
    CHECK(std::log2(coarse / fine) > 0.9);
  }
}

}  // namespace
}  // namespace vocalis::contact
