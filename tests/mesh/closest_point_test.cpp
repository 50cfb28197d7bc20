#include "core/mesh/closest_point.hpp"

#include <cmath>
#include <random>

#include "core/mesh/cell_tree.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

using Point = std::array<double, 3>;

Point at(const mesh::Mesh& mesh, std::int32_t cell, const std::array<double, 4>& barycentric) {
  Point result = {0, 0, 0};
  for (int i = 0; i <= mesh.dimension; ++i) {
    for (int k = 0; k < mesh.dimension; ++k) {
      result[k] += barycentric[i] * mesh.point(mesh.vertices_of(cell)[i])[k];
    }
  }
  return result;
}

/// c is the point of a convex cell that is nearest to x if and only if (x - c)·(y - c) <= 0 for all corners y.
bool is_nearest(const mesh::Mesh& mesh, std::int32_t cell, const Point& x, const Point& c) {
  for (const std::int32_t vertex : mesh.vertices_of(cell)) {
    double product = 0;
    for (int k = 0; k < mesh.dimension; ++k) product += (x[k] - c[k]) * (mesh.point(vertex)[k] - c[k]);
    if (product > 1e-12) return false;
  }
  return true;
}

Point random_point(std::mt19937& random, int dimension, double low, double high) {
  std::uniform_real_distribution<double> number(low, high);
  Point result = {0, 0, 0};
  for (int k = 0; k < dimension; ++k) result[k] = number(random);
  return result;
}

/// With obtuse cells: beyond their corners more than one facet may be nearest.
mesh::Mesh sheared_box(double depth, std::array<int, 3> cells) {
  mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 0.5, depth}, cells));
  const std::size_t d = box.dimension;
  for (std::int32_t v = 0; v < box.num_vertices(); ++v) {
    box.coordinates[v * d] += 1.5 * box.coordinates[v * d + 1] - (d == 3 ? 0.7 * box.coordinates[v * d + 2] : 0);
  }
  return box;
}

}  // namespace

TEST_CASE("the closest point of a cell is the nearest of all its points") {
  std::mt19937 random(7);
  for (const double depth : {0.0, 1.0}) {
    const mesh::Mesh box = sheared_box(depth, {2, 3, 2});
    int inside = 0;
    for (int trial = 0; trial < 200; ++trial) {
      const Point x = random_point(random, box.dimension, -0.5, 1.5);
      for (std::int32_t cell = 0; cell < box.num_cells(); ++cell) {
        const mesh::ClosestPoint closest = mesh::closest_point(box, cell, x);
        const Point c = at(box, cell, closest.barycentric);
        CHECK(is_nearest(box, cell, x, c));
        CHECK(std::hypot(x[0] - c[0], x[1] - c[1], x[2] - c[2]) == Approx(closest.distance).margin(1e-9));
        inside += closest.distance == 0;
      }
    }
    if (box.num_cells() > 0) CHECK(inside > 0);
  }
}

TEST_CASE("a tree of cells finds the nearest one") {
  std::mt19937 random(8);
  for (const double depth : {0.0, 1.0}) {
    const mesh::Mesh box = sheared_box(depth, {9, 8, 3});
    const mesh::CellTree tree(box);
    for (int trial = 0; trial < 300; ++trial) {
      const Point x = random_point(random, box.dimension, -0.2, 1.2);
      double distance = mesh::Box::infinity;
      for (std::int32_t cell = 0; cell < box.num_cells(); ++cell) {
        distance = std::min(distance, mesh::closest_point(box, cell, x).distance);
      }
      const mesh::NearestCell nearest = tree.nearest(x, 2);
      CHECK((nearest.cell >= 0) == (box.num_cells() > 0));
      if (nearest.cell < 0) continue;
      CHECK(nearest.closest.distance == Approx(distance).margin(1e-14));
      CHECK(mesh::closest_point(box, nearest.cell, x).distance == nearest.closest.distance);
      CHECK((tree.nearest(x, 0.05).cell >= 0) == (distance <= 0.05));
    }
  }
}
