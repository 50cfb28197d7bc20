#include "core/mesh/mesh.hpp"

#include <algorithm>
#include <set>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

/// Cells dealt out like cards: no rank has two neighbours in a row, and every vertex is shared.
mesh::Mesh dealt(const mesh::WholeMesh& whole) {
  std::vector<std::int32_t> rank;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    rank.push_back(static_cast<std::int32_t>(cell % base::size(MPI_COMM_WORLD)));
  }
  return mesh::build_mesh(MPI_COMM_WORLD, mesh::scatter(MPI_COMM_WORLD, whole, rank));
}

mesh::Mesh dealt_box(std::array<double, 3> size, std::array<int, 3> cells) {
  return dealt(mesh::box(MPI_COMM_WORLD, size, cells));
}

double total_volume(const mesh::Mesh& mesh) {
  double sum = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const double volume = mesh::signed_volume(mesh, mesh.vertices_of(cell));
    CHECK(volume > 0);
    sum += volume;
  }
  return base::sum(MPI_COMM_WORLD, sum);
}

}  // namespace

TEST_CASE("numbers of entities obey Euler's formula, however cells are dealt out") {
  // A disc has V - E + F = 1, a ball V - E + F - C = 1; facets are counted from cells and boundary facets.
  const mesh::Mesh plane = dealt_box({1, 1, 0}, {3, 2, 0});
  CHECK(plane.vertices.num_global == 12);
  CHECK(plane.cells.num_global == 12);
  CHECK(plane.vertices.num_global - plane.edges.num_global + plane.cells.num_global == 1);
  const mesh::Mesh solid = dealt_box({1, 1, 1}, {2, 3, 2});
  CHECK(solid.vertices.num_global == 36);
  CHECK(solid.cells.num_global == 72);
  const std::int64_t facets = (4 * 72 + 4 * (2 * 3 + 3 * 2 + 2 * 2)) / 2;
  CHECK(solid.vertices.num_global - solid.edges.num_global + facets - solid.cells.num_global == 1);
  CHECK(total_volume(plane) == Approx(1));
  CHECK(total_volume(solid) == Approx(1));
}

TEST_CASE("copies of a vertex and of an edge are at one place on all ranks") {
  for (const double depth : {0.0, 1.0}) {
    const mesh::Mesh mesh = dealt_box({1, 2, depth}, {2, 2, 2});
    std::vector<double> points = mesh.coordinates;
    mesh.vertex_halo.copy_to_ghosts(points, mesh.dimension);
    CHECK(points == mesh.coordinates);
    std::vector<double> middles(mesh.edges.num_local() * mesh.dimension);
    for (std::int32_t edge = 0; edge < mesh.edges.num_local(); ++edge) {
      for (int k = 0; k < mesh.dimension; ++k) {
        middles[edge * mesh.dimension + k] =
            mesh.point(mesh.edge_vertices[2 * edge])[k] + 2 * mesh.point(mesh.edge_vertices[2 * edge + 1])[k];
      }
    }
    const std::vector<double> before = middles;
    mesh.edge_halo.copy_to_ghosts(middles, mesh.dimension);
    CHECK(middles == before);
    std::vector<std::int64_t> input = mesh.vertex_input;
    mesh.vertex_halo.copy_to_ghosts(input);
    CHECK(input == mesh.vertex_input);
  }
}

TEST_CASE("the edges of a cell join its vertices in the stated order") {
  const mesh::Mesh mesh = dealt_box({1, 1, 1}, {2, 1, 1});
  const auto pairs = mesh::edges_of_cell(3);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (std::size_t e = 0; e < pairs.size(); ++e) {
      const std::int32_t* ends = mesh.edge_vertices.data() + 2 * mesh.cell_edges[cell * pairs.size() + e];
      const std::set<std::int32_t> wanted = {mesh.vertices_of(cell)[pairs[e][0]], mesh.vertices_of(cell)[pairs[e][1]]};
      CHECK(std::set<std::int32_t>{ends[0], ends[1]} == wanted);
    }
  }
}

TEST_CASE("neighbours see each other across the facet they share, on other ranks too") {
  for (const double depth : {0.0, 1.0}) {
    const mesh::Mesh mesh = dealt_box({1, 1, depth}, {3, 3, 2});
    const int corners = mesh.dimension + 1;
    // Middle of each cell, also of ghosts: across a facet it lies on the other side.
    std::vector<double> middle(static_cast<std::size_t>(mesh.cells.num_local()) * mesh.dimension, 0.0);
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      for (const std::int32_t vertex : mesh.vertices_of(cell)) {
        for (int k = 0; k < mesh.dimension; ++k) middle[cell * mesh.dimension + k] += mesh.point(vertex)[k] / corners;
      }
    }
    mesh.cell_halo.copy_to_ghosts(middle, mesh.dimension);
    std::int64_t outer = 0;
    bool across = true;
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      for (int i = 0; i < corners; ++i) {
        const std::int32_t other = mesh.cell_neighbours[cell * corners + i];
        if (other < 0) {
          ++outer;
          continue;
        }
        const auto normal = mesh::facet_geometry(mesh, cell, i).normal;
        double step = 0;
        for (int k = 0; k < mesh.dimension; ++k) {
          step += normal[k] * (middle[other * mesh.dimension + k] - middle[cell * mesh.dimension + k]);
        }
        across = across && step > 0;
      }
    }
    CHECK(across);
    CHECK(base::sum(MPI_COMM_WORLD, outer) == (mesh.dimension == 2 ? 12 : 2 * 2 * (9 + 6 + 6)));
  }
}

// Two ranks and two triangles: 0 = (0 1 3) on rank 0, 1 = (0 3 2) on rank 1.
//   2 --- 3
//   | 1 / |
//   |  /  |
//   | / 0 |
//   0 --- 1
TEST_CASE("two triangles on two ranks give the arrays drawn here") {
  if (base::size(MPI_COMM_WORLD) != 2) return;
  const mesh::Mesh mesh = dealt_box({1, 1, 0}, {1, 1, 0});
  using Numbers = std::vector<std::int64_t>;
  if (base::rank(MPI_COMM_WORLD) == 0) {
    CHECK(mesh.vertex_input == Numbers{0, 1, 3});
    CHECK(mesh.vertices.num_ghosts() == 0);
    CHECK(mesh.edges.num_owned == 3);
    CHECK(mesh.cells.ghost_global == Numbers{1});
    CHECK(mesh.named_facets.size() == 2);
  } else {
    // The cell is given as 0 2 3, which is clockwise, so it is turned; vertex 2 is the only one owned here.
    CHECK(mesh.vertex_input == Numbers{2, 0, 3});
    CHECK(mesh.vertices.num_owned == 1);
    CHECK(mesh.vertices.ghost_global == Numbers{0, 2});
    CHECK(mesh.vertices.ghost_owner == std::vector<int>{0, 0});
    CHECK(mesh.cell_vertices == std::vector<std::int32_t>{1, 2, 0});
    CHECK(mesh.edges.num_owned == 2);
    CHECK(mesh.edges.num_global == 5);
    CHECK(mesh.cells.ghost_global == Numbers{0});
    // Across the facet opposite to vertex 2 lies the ghost, local cell 1.
    CHECK(mesh.cell_neighbours == std::vector<std::int32_t>{-1, -1, 1});
  }
}

TEST_CASE("curved edges have their own middles on all ranks, straight ones the mean of their ends") {
  for (const double depth : {0.0, 1.0}) {
    mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, depth}, {2, 2, 2});
    const int d = whole.dimension;
    CHECK(dealt(whole).edge_points.empty());
    // The edges that end at vertex 0 bulge, as if seen from the other end; the last pair is no edge of any cell.
    std::set<std::int64_t> far_ends;
    for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
      const auto first = whole.cell_vertices.begin() + cell * (d + 1);
      if (std::find(first, first + d + 1, 0) == first + d + 1) continue;
      far_ends.insert(first, first + d + 1);
    }
    far_ends.erase(0);
    if (base::rank(MPI_COMM_WORLD) == 0) far_ends.insert(static_cast<std::int64_t>(whole.coordinates.size()) / d - 1);
    for (const std::int64_t end : far_ends) {
      whole.curved_edges.insert(whole.curved_edges.end(), {end, 0});
      for (int k = 0; k < d; ++k) whole.curved_points.push_back(static_cast<double>(end) + 0.25 * k);
    }
    const mesh::Mesh mesh = dealt(whole);
    REQUIRE_ON_ALL_RANKS(mesh.edge_points.size() == static_cast<std::size_t>(mesh.edges.num_local()) * d);
    bool right = true;
    std::int64_t num_curved = 0;
    for (std::int32_t edge = 0; edge < mesh.edges.num_local(); ++edge) {
      const std::int32_t* ends = mesh.edge_vertices.data() + 2 * edge;
      const auto [low, high] = std::minmax(mesh.vertex_input[ends[0]], mesh.vertex_input[ends[1]]);
      if (low == 0 && edge < mesh.edges.num_owned) ++num_curved;
      for (int k = 0; k < d; ++k) {
        const double straight = 0.5 * (mesh.point(ends[0])[k] + mesh.point(ends[1])[k]);
        const double wanted = low == 0 ? static_cast<double>(high) + 0.25 * k : straight;
        right = right && mesh.edge_points[edge * d + k] == wanted;
      }
    }
    CHECK(right);
    CHECK(base::sum(MPI_COMM_WORLD, num_curved) == (d == 2 ? 3 : 7));
  }
}

TEST_CASE("names are found by index") {
  const std::vector<std::string> names = {"air", "fold"};
  CHECK(mesh::index_of(names, "fold") == 1);
  CHECK(mesh::index_of(names, "lung") == -1);
}
