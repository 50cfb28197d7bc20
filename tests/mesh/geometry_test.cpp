#include "core/mesh/geometry.hpp"

#include <cmath>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

/// One cell, on rank 0.
mesh::Mesh one_cell(const std::vector<double>& coordinates, int dimension) {
  mesh::WholeMesh whole;
  whole.dimension = dimension;
  whole.region_names = {"all"};
  if (base::rank(MPI_COMM_WORLD) == 0) {
    whole.coordinates = coordinates;
    for (int i = 0; i <= dimension; ++i) whole.cell_vertices.push_back(i);
    whole.cell_region = {0};
  }
  return mesh::build_mesh(MPI_COMM_WORLD, mesh::scatter(MPI_COMM_WORLD, whole, {0}));
}

}  // namespace

TEST_CASE("volumes, facets and normals of a triangle and a tetrahedron") {
  const mesh::Mesh triangle = one_cell({0, 0, 4, 0, 0, 3}, 2);
  if (triangle.num_cells() == 1) {
    CHECK(mesh::signed_volume(triangle, triangle.vertices_of(0)) == Approx(6));
    // Opposite to (0, 0): the side of length 5 with the normal (3, 4) / 5.
    const auto side = mesh::facet_geometry(triangle, 0, 0);
    CHECK(side.measure == Approx(5));
    CHECK(side.normal[0] == Approx(0.6));
    CHECK(side.normal[1] == Approx(0.8));
    CHECK(mesh::facet_vertices(triangle, 0, 0)[0] == triangle.vertices_of(0)[1]);
    CHECK(mesh::facet_vertices(triangle, 0, 1)[1] == triangle.vertices_of(0)[2]);
  }
  const mesh::Mesh tetrahedron = one_cell({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, 3);
  if (tetrahedron.num_cells() == 1) {
    CHECK(mesh::signed_volume(tetrahedron, tetrahedron.vertices_of(0)) == Approx(1.0 / 6));
    const auto slope = mesh::facet_geometry(tetrahedron, 0, 0);
    CHECK(slope.measure == Approx(std::sqrt(3.0) / 2));
    for (int k = 0; k < 3; ++k) CHECK(slope.normal[k] == Approx(1 / std::sqrt(3.0)));
    const auto floor = mesh::facet_geometry(tetrahedron, 0, 3);
    CHECK(floor.measure == Approx(0.5));
    CHECK(floor.normal[2] == Approx(-1));
  }
}

TEST_CASE("the normals of a cell times their measures add up to nothing") {
  for (const double depth : {0.0, 0.7}) {
    const mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 2, depth}, {2, 3, 2}));
    double largest = 0;
    for (std::int32_t cell = 0; cell < box.num_cells(); ++cell) {
      double sum[3] = {0, 0, 0};
      for (int i = 0; i <= box.dimension; ++i) {
        const auto facet = mesh::facet_geometry(box, cell, i);
        for (int k = 0; k < 3; ++k) sum[k] += facet.measure * facet.normal[k];
      }
      for (const double component : sum) largest = std::max(largest, std::abs(component));
    }
    CHECK(largest < 1e-14);
  }
}

TEST_CASE("quality is 1 for regular cells, falls with stretching, and is negative when inverted") {
  const double h = std::sqrt(3.0) / 2;
  mesh::Mesh triangle = one_cell({0, 0, 1, 0, 0.5, h}, 2);
  CHECK(mesh::smallest_quality(triangle) == Approx(1));
  const mesh::Mesh tetrahedron = one_cell({0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, h / 3, std::sqrt(2.0 / 3)}, 3);
  CHECK(mesh::smallest_quality(tetrahedron) == Approx(1));
  // F = diag(1, s) has Q = 2 s / (1 + s²).
  for (std::size_t i = 1; i < triangle.coordinates.size(); i += 2) triangle.coordinates[i] *= 3;
  CHECK(mesh::smallest_quality(triangle) == Approx(0.6));
  for (std::size_t i = 1; i < triangle.coordinates.size(); i += 2) triangle.coordinates[i] *= -1;
  CHECK(mesh::smallest_quality(triangle) == Approx(-0.6));
}
