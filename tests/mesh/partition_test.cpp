#include "core/mesh/partition.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

TEST_CASE("two kinds of work are balanced each by itself", "[serial]") {
  const mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {30, 30, 0});
  // The left third is flow work alone, the right third sound alone, the middle both.
  std::vector<std::int32_t> work;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    double x = 0;
    for (int i = 0; i < 3; ++i) x += whole.coordinates[2 * whole.cell_vertices[3 * cell + i]] / 3;
    work.push_back(x < 0.67 ? 3 : 0);
    work.push_back(x > 0.33 ? 1 : 0);
  }
  for (const int ranks : {2, 4}) {
    const auto cell_rank = mesh::partition_cells(whole, ranks, work, 2);
    for (int kind = 0; kind < 2; ++kind) {
      std::vector<double> load(ranks, 0.0);
      for (std::size_t cell = 0; cell < cell_rank.size(); ++cell) load[cell_rank[cell]] += work[2 * cell + kind];
      const double mean = std::accumulate(load.begin(), load.end(), 0.0) / ranks;
      CHECK(*std::max_element(load.begin(), load.end()) < 1.1 * mean);
    }
    CHECK(mesh::partition_cells(whole, ranks, work, 2) == cell_rank);
  }
}

TEST_CASE("a mesh smaller than the number of ranks leaves some empty") {
  const mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {1, 1, 0});
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, whole);
  CHECK(mesh.cells.num_global == 2);
  CHECK(mesh.vertices.num_global == 4);
  CHECK(mesh.region_names == std::vector<std::string>{"box"});
  CHECK(mesh.group_names.size() == 4);
}

TEST_CASE("all cells on the last rank") {
  const mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 1}, {2, 2, 2});
  const int last = base::size(MPI_COMM_WORLD) - 1;
  const std::vector<std::int32_t> rank(whole.num_cells(), last);
  const mesh::Mesh mesh = mesh::build_mesh(MPI_COMM_WORLD, mesh::scatter(MPI_COMM_WORLD, whole, rank));
  CHECK(mesh.num_cells() == (base::rank(MPI_COMM_WORLD) == last ? 48 : 0));
  CHECK(mesh.vertices.num_ghosts() == 0);
  CHECK(mesh.vertices.num_global == 27);
  CHECK(mesh::smallest_quality(mesh) > 0.5);
}

TEST_CASE("regions travel with their cells, to ghosts too") {
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {6, 6, 0});
  whole.region_names = {"low", "high"};
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) whole.cell_region[cell] = cell >= 36 ? 1 : 0;
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, whole);
  bool right = true;
  std::vector<std::int32_t> region = mesh.cell_region;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double y = 0;
    for (const std::int32_t vertex : mesh.vertices_of(cell)) y += mesh.point(vertex)[1] / 3;
    right = right && mesh.cell_region[cell] == (y > 0.5 ? 1 : 0);
  }
  CHECK(right);
  mesh.cell_halo.copy_to_ghosts(region);
  CHECK(region == mesh.cell_region);
  CHECK(static_cast<std::int32_t>(region.size()) == mesh.cells.num_local());
}
