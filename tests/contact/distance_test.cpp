#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "contact/nearest_facet.hpp"
#include "contact/wall_distance.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/contact/scenes.hpp"

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

struct Errors {
  double largest = 0, mean = 0;  ///< over the largest distance
  bool converged = true;
};

Errors errors_of(const Scene& scene, int dimension, int refinement, bool by_equation, bool is_shaken = false,
                 const EikonalSettings& settings = {}) {
  SceneMesh built = build(scene, dimension, refinement);
  if (is_shaken) shake(built, refinement);
  const mesh::Mesh& mesh = built.mesh;
  const fem::Space space = built.space();
  Eikonal eikonal(space);
  EikonalReport report;
  report.converged = !by_equation;
  const WallDistance walls =
      by_equation ? eikonal_distance(eikonal, space, built.walls, mesh.coordinates, {}, settings, {}, report)
                  : direct_distance(space, built.walls, mesh.coordinates, {}, 1e9);
  Errors errors;
  errors.converged = report.converged;
  for (std::int32_t dof = 0; dof < space.dofs.num_owned; ++dof) {
    const double exact = scene.distance(dimension, mesh.point(space.dof_vertex[dof]));
    const double error = std::abs(walls.distance.values[dof] - exact) / scene.length;
    errors.largest = std::max(errors.largest, error);
    errors.mean += error / static_cast<double>(space.dofs.num_global);
  }
  errors.largest = base::largest(mesh.comm, errors.largest);
  errors.mean = base::sum(mesh.comm, errors.mean);
  return errors;
}

const Scene& sharp_wedge = wedge_scene<5>;

TEST_CASE("The direct distance is exact between flat walls, and of second order between curved ones") {
  for (const int dimension : {2, 3}) {
    for (const Scene* scene : {&channel_scene, &l_scene, &sharp_wedge, &gap_scene}) {
      INFO(scene->name << " in " << dimension << " dimensions");
      CHECK(errors_of(*scene, dimension, 2, false).largest < 1e-12);
    }
    const double coarse = errors_of(discs_scene, dimension, 2, false).largest;
    CHECK(std::log2(coarse / errors_of(discs_scene, dimension, 4, false).largest) > 1.8);
  }
}

struct Orders {
  double largest = 0, mean = 0;
};

/// Between a mesh and one of half the spacing.
Orders orders_of(const Scene& scene, int dimension, int refinement, bool is_shaken = false,
                 const EikonalSettings& settings = {}) {
  const Errors coarse = errors_of(scene, dimension, refinement, true, is_shaken, settings);
  const Errors fine = errors_of(scene, dimension, 2 * refinement, true, is_shaken, settings);
  REQUIRE(coarse.converged);
  REQUIRE(fine.converged);
  UNSCOPED_INFO(scene.name << " in " << dimension << " dimensions, largest " << coarse.largest << " " << fine.largest
                           << ", mean " << coarse.mean << " " << fine.mean);
  return {std::log2(coarse.largest / fine.largest), std::log2(coarse.mean / fine.mean)};
}

/// The wedge takes finer meshes in space: up to these its largest error over h still rises to its limit.
TEST_CASE("The Eikonal equation converges to the distance at first order, in the mean faster") {
  const std::vector<std::pair<const Scene*, int>> coarser_in_space = {
      {&channel_scene, 2}, {&discs_scene, 2}, {&l_scene, 4}, {&sharp_wedge, 8}, {&gap_scene, 2}};
  for (const auto& [scene, in_space] : coarser_in_space) {
    for (const int dimension : {2, 3}) {
      const Orders orders = orders_of(*scene, dimension, dimension == 2 ? 8 : in_space);
      CHECK(orders.largest > 0.9);
      CHECK(orders.mean > 1.3);
    }
  }
}

TEST_CASE("Without corrections a corner that points into the fluid costs more than first order") {
  const Orders orders = orders_of(l_scene, 2, 8, false, {.corrections = 0});
  CHECK(orders.largest < 0.7);
  CHECK(orders.mean < 1.1);
}

TEST_CASE("On irregular meshes four corrections bring first order around a corner that points into the fluid") {
  for (const int dimension : {2, 3}) {
    const Orders orders = orders_of(l_scene, dimension, dimension == 2 ? 8 : 4, true, {.corrections = 4});
    CHECK(orders.largest > 0.9);
    CHECK(orders.mean > 1.3);
  }
}

/// Values at points, of the whole mesh.
std::map<std::vector<double>, double> values_at_points(const Scene& scene, int dimension, bool by_equation,
                                                       MPI_Comm comm) {
  const SceneMesh built = build(scene, dimension, 2, comm);
  const fem::Space space = built.space();
  Eikonal eikonal(space);
  EikonalReport report;
  const WallDistance walls =
      by_equation ? eikonal_distance(eikonal, space, built.walls, built.mesh.coordinates, {}, {}, {}, report)
                  : direct_distance(space, built.walls, built.mesh.coordinates, {}, 1e9);
  std::map<std::vector<double>, double> values;
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    const double* point = built.mesh.point(space.dof_vertex[dof]);
    values[{point, point + dimension}] = walls.distance.values[dof];
  }
  return values;
}

TEST_CASE("Distances are the same on any number of ranks") {
  const bool by_equation = GENERATE(false, true);
  for (const int dimension : {2, 3}) {
    for (const Scene* scene : {&discs_scene, &l_scene, &sharp_wedge}) {
      const auto alone = values_at_points(*scene, dimension, by_equation, MPI_COMM_SELF);
      double difference = 0;
      for (const auto& [point, value] : values_at_points(*scene, dimension, by_equation, MPI_COMM_WORLD)) {
        difference = std::max(difference, std::abs(value - alone.at(point)));
      }
      INFO(scene->name << " in " << dimension << " dimensions");
      CHECK(difference <= 1e-8 * scene->length);
    }
  }
}

TEST_CASE("From the last distance the next takes fewer iterations") {
  const SceneMesh built = build(discs_scene, 2, 8);
  const fem::Space space = built.space();
  Eikonal eikonal(space);
  EikonalReport cold, warm;
  const auto first = eikonal_distance(eikonal, space, built.walls, built.mesh.coordinates, {}, {}, {}, cold);
  std::vector<double> nearer = built.mesh.coordinates;  // the upper half comes down by a tenth of a cell
  for (std::size_t i = 1; i < nearer.size(); i += 2) nearer[i] *= 1 - 0.1 / 32;
  const auto next = eikonal_distance(eikonal, space, built.walls, nearer, {}, {}, first.distance.values, warm);
  REQUIRE(cold.converged);
  REQUIRE(warm.converged);
  INFO(cold.iterations << " cold, " << warm.iterations << " warm");
  CHECK(warm.linear_iterations < cold.linear_iterations);
  CHECK(warm.iterations < cold.iterations);
}

}  // namespace
}  // namespace vocalis::contact
