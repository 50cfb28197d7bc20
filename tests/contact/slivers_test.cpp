#include "contact/slivers.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "contact/walls.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::contact {
namespace {

struct Found {
  int cells = 0;
  std::vector<std::array<double, 2>> middles;  ///< on this rank
};

/// Slivers between the walls y = 0 and y = `rows` of squares of unit size, cut along their rising diagonals, where both
/// cells of the square (1, row) are in contact.
Found slivers_beside(int rows, int row) {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {4, 1.0 * rows, 0}, {4, rows, 0}));
  const std::vector<std::int32_t> groups = {mesh::index_of(mesh.group_names, "bottom"),
                                            mesh::index_of(mesh.group_names, "top")};
  const std::vector<char> fluid(mesh.cells.num_local(), 1);
  const fem::Space space = fem::lagrange(mesh, 1);
  const WallDistance walls = direct_distance(space, wall_facets(mesh, fluid, groups), mesh.coordinates, {}, 1e9);
  std::vector<std::array<double, 2>> middles(mesh.num_cells());
  std::vector<char> in_contact(mesh.num_cells());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      for (int k = 0; k < 2; ++k) middles[cell][k] += mesh.point(v)[k] / 3;
    }
    in_contact[cell] = static_cast<int>(middles[cell][0]) == 1 && static_cast<int>(middles[cell][1]) == row;
  }
  const std::vector<char> slivers = find_slivers(walls, in_contact);
  Found found;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    CHECK_FALSE((slivers[cell] && in_contact[cell]));
    if (slivers[cell]) found.middles.push_back(middles[cell]);
  }
  found.cells = base::sum(mesh.comm, static_cast<int>(found.middles.size()));
  return found;
}

}  // namespace

TEST_CASE("Cells between a contact cell and a wall that have no corner of their own are slivers") {
  const Found found = slivers_beside(2, 1);
  CHECK(found.cells == 4);
  const std::vector<std::array<double, 2>> expected = {
      {5.0 / 3, 1.0 / 3}, {4.0 / 3, 2.0 / 3}, {2.0 / 3, 1.0 / 3}, {7.0 / 3, 5.0 / 3}};
  for (const auto& middle : found.middles) {
    const bool is_expected = std::any_of(expected.begin(), expected.end(), [&](const auto& place) {
      return std::abs(place[0] - middle[0]) + std::abs(place[1] - middle[1]) < 1e-9;
    });
    INFO(middle[0] << " " << middle[1]);
    CHECK(is_expected);
  }
}

TEST_CASE("Where one cell reaches from wall to wall no contact cell makes slivers") {
  CHECK(slivers_beside(1, 0).cells == 0);
}

}  // namespace vocalis::contact
