#include "core/mesh/facets.hpp"

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

mesh::WholeMesh box_of(int dimension) {
  return mesh::box(MPI_COMM_WORLD, {1, 2, dimension == 3 ? 3.0 : 0.0}, {2, 2, 2});
}

double measure(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets) {
  double sum = 0;
  for (const auto& facet : facets) sum += mesh::facet_geometry(mesh, facet.cell, facet.index).measure;
  return base::sum(mesh.comm, sum);
}

}  // namespace

TEST_CASE("the sides of a box have their measure and their normal") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, box_of(dimension));
    const double depth = dimension == 3 ? 3 : 1;
    CHECK(measure(box, mesh::facets_of_group(box, "left")) == Approx(2 * depth));
    CHECK(measure(box, mesh::facets_of_group(box, "top")) == Approx(depth));
    CHECK(mesh::facets_of_group(box, "nothing").empty());
    for (const auto& facet : mesh::facets_of_group(box, "right")) {
      CHECK(mesh::facet_geometry(box, facet.cell, facet.index).normal[0] == Approx(1));
    }
    const auto outer = mesh::boundary_facets(box);
    CHECK(measure(box, outer) == Approx(dimension == 2 ? 6.0 : 2 * (2 + 6 + 3)));
    for (const auto& facet : outer) CHECK(facet.group >= 0);
  }
}

TEST_CASE("an inner named facet is listed from both sides, and is no boundary") {
  mesh::WholeMesh whole = box_of(2);
  whole.group_names.push_back("membrane");
  if (base::rank(MPI_COMM_WORLD) == 0) {
    // The vertical line x = 1/2: points 1 4 7 of the 3 x 3 grid.
    whole.facet_vertices.insert(whole.facet_vertices.end(), {1, 4, 7, 4});
    whole.facet_group.insert(whole.facet_group.end(), {4, 4});
  }
  const mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, whole);
  const auto membrane = mesh::facets_of_group(box, "membrane");
  CHECK(base::sum(MPI_COMM_WORLD, static_cast<std::int64_t>(membrane.size())) == 4);
  double balance = 0;
  for (const auto& facet : membrane) balance += mesh::facet_geometry(box, facet.cell, facet.index).normal[0];
  CHECK(base::sum(MPI_COMM_WORLD, balance) == Approx(0).margin(1e-14));
  for (const auto& facet : mesh::boundary_facets(box)) CHECK(facet.group != 4);
  CHECK(mesh::exterior_facets_of_group(box, "membrane").empty());
  CHECK(mesh::exterior_facets_of_group(box, "left").size() == mesh::facets_of_group(box, "left").size());
}

TEST_CASE("vertices of a side and of cells are marked on every rank that has them") {
  const mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, box_of(3));
  const auto marks = mesh::mark_vertices(box, mesh::facets_of_group(box, "left"));
  bool right = true;
  for (std::int32_t v = 0; v < box.num_vertices(); ++v) right = right && (marks[v] != 0) == (box.point(v)[0] == 0);
  CHECK(right);

  std::vector<std::int32_t> lower(box.num_cells(), 0);
  for (std::int32_t cell = 0; cell < box.num_cells(); ++cell) {
    double middle = 0;
    for (const std::int32_t v : box.vertices_of(cell)) middle += box.point(v)[2] / 4;
    lower[cell] = middle < 1.5;
  }
  const auto of_cells = mesh::mark_vertices_of_cells(box, lower);
  for (std::int32_t v = 0; v < box.num_vertices(); ++v) right = right && (of_cells[v] != 0) == (box.point(v)[2] <= 1.5);
  CHECK(right);
}
