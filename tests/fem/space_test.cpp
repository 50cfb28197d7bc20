#include "core/fem/space.hpp"

#include <cmath>
#include <set>

#include "core/base/mpi.hpp"
#include "core/fem/field.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

mesh::Mesh box(int dimension) {
  return mesh::distribute(
      MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {2, 1, dimension == 3 ? 1.0 : 0.0}, {4, 2, dimension == 3 ? 2 : 0}));
}

double middle_x(const mesh::Mesh& mesh, std::int32_t cell) {
  double x = 0;
  for (const std::int32_t vertex : mesh.vertices_of(cell)) x += mesh.point(vertex)[0] / (mesh.dimension + 1);
  return x;
}

/// Label 0 where x < 1, label 1 beyond.
std::vector<std::int32_t> two_labels(const mesh::Mesh& mesh) {
  std::vector<std::int32_t> labels;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) labels.push_back(middle_x(mesh, cell) < 1 ? 0 : 1);
  return labels;
}

/// A field whose copies all have the owner's value, or not.
bool is_consistent(fem::Field field) {
  const auto before = field.values;
  field.copy_to_ghosts();
  return before == field.values;
}

}  // namespace

TEST_CASE("numbers of dofs are those of vertices and edges") {
  // 4 x 2 squares: 15 vertices; edges by Euler: E = V + C - 1 = 15 + 16 - 1.
  const mesh::Mesh plane = box(2);
  CHECK(fem::lagrange(plane, 1).dofs.num_global == 15);
  CHECK(fem::lagrange(plane, 2).dofs.num_global == 15 + 30);
  // P2 on a box of Kuhn bricks is the grid of twice the fineness.
  const mesh::Mesh solid = box(3);
  CHECK(fem::lagrange(solid, 1).dofs.num_global == 45);
  CHECK(fem::lagrange(solid, 2).dofs.num_global == 9 * 5 * 5);
  CHECK(fem::lagrange(solid, 2).dofs_per_cell == 10);
}

TEST_CASE("degree 1 with one label has the numbering of the vertices") {
  const mesh::Mesh mesh = box(3);
  const fem::Space space = fem::lagrange(mesh, 1);
  CHECK(space.dofs.num_owned == mesh.vertices.num_owned);
  CHECK(space.dofs.offset == mesh.vertices.offset);
  CHECK(space.dofs.ghost_global == mesh.vertices.ghost_global);
  CHECK(space.dofs.ghost_owner == mesh.vertices.ghost_owner);
  CHECK(space.cell_dofs == mesh.cell_vertices);
  bool same = true;
  for (std::int32_t i = 0; i < space.num_dofs(); ++i)
    same = same && space.dof_vertex[i] == i && space.dof_edge[i] == -1;
  CHECK(same);
}

TEST_CASE("labelled spaces have their own dofs on each side of an interface") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = box(dimension);
    const std::int64_t shared = dimension == 2 ? 3 : 9, shared_fine = dimension == 2 ? 5 : 25;
    const fem::Space once = fem::lagrange(mesh, 1), twice = fem::lagrange(mesh, 1, two_labels(mesh));
    CHECK(twice.dofs.num_global == once.dofs.num_global + shared);
    CHECK(fem::lagrange(mesh, 2, two_labels(mesh)).dofs.num_global ==
          fem::lagrange(mesh, 2).dofs.num_global + shared_fine);

    fem::Field label(twice, 1);
    for (std::int32_t i = 0; i < twice.num_dofs(); ++i) label.at(i)[0] = twice.dof_label[i];
    CHECK(is_consistent(label));
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      const auto dofs = twice.dofs_of(cell);
      for (int i = 0; i <= dimension; ++i) {
        CHECK(twice.dof_label[dofs[i]] == (middle_x(mesh, cell) < 1 ? 0 : 1));
        CHECK(twice.dof_vertex[dofs[i]] == mesh.vertices_of(cell)[i]);
      }
    }
  }
}

TEST_CASE("cells without a label have no dofs, and a space may be nowhere") {
  const mesh::Mesh mesh = box(2);
  std::vector<std::int32_t> labels = two_labels(mesh);
  for (auto& label : labels) label = label == 0 ? -1 : 4;
  const fem::Space half = fem::lagrange(mesh, 2, labels);
  CHECK(half.dofs.num_global == 5 * 5);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t dof : half.dofs_of(cell)) CHECK((dof < 0) == (labels[cell] < 0));
  }
  const fem::Space nowhere = fem::lagrange(mesh, 1, std::vector<std::int32_t>(mesh.num_cells(), -1));
  CHECK(nowhere.dofs.num_global == 0);
}

TEST_CASE("dofs are where they say, on owner and ghost alike") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = box(dimension);
    const fem::Space space = fem::lagrange(mesh, 2, two_labels(mesh));
    fem::Field points(space, dimension);
    points.values = fem::dof_points(space);
    CHECK(is_consistent(points));
    // All dofs of one label lie at different points of the fine grid.
    std::set<std::array<double, 4>> seen;
    for (std::int32_t i = 0; i < space.num_dofs(); ++i) {
      std::array<double, 4> key = {0, 0, 0, static_cast<double>(space.dof_label[i])};
      for (int k = 0; k < dimension; ++k) {
        key[k] = points.at(i)[k];
        CHECK(std::abs(4 * key[k] - std::round(4 * key[k])) < 1e-14);
      }
      seen.insert(key);
    }
    CHECK(seen.size() == static_cast<std::size_t>(space.num_dofs()));
  }
}
