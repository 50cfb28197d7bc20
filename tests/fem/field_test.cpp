#include "core/fem/field.hpp"

#include <cmath>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"
#include "tests/interpolate.hpp"

using namespace vocalis;

namespace {

mesh::Mesh box() { return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 1}, {3, 2, 2})); }

}  // namespace

TEST_CASE("a load keeps its total when it goes to the owners, and adding twice changes nothing") {
  const mesh::Mesh mesh = box();
  const fem::Space space = fem::lagrange(mesh, 1);
  fem::Load load(space, 2);
  // The volume of each cell shared by its vertices: the total is that of the box.
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t dof : space.dofs_of(cell)) {
      load.at(dof)[0] += mesh::signed_volume(mesh, mesh.vertices_of(cell)) / 4;
      load.at(dof)[1] += 1;
    }
  }
  load.add_to_owners();
  const auto once = load.values;
  load.add_to_owners();
  CHECK(load.values == once);
  double volume = 0, count = 0, on_ghosts = 0;
  for (std::int32_t i = 0; i < space.num_dofs(); ++i) {
    volume += load.at(i)[0];
    count += load.at(i)[1];
    if (i >= space.dofs.num_owned) on_ghosts += std::abs(load.at(i)[0]);
  }
  CHECK(base::sum(MPI_COMM_WORLD, volume) == Approx(1).epsilon(1e-14));
  CHECK(base::sum(MPI_COMM_WORLD, count) == 4 * 72);
  CHECK(on_ghosts == 0);
}

TEST_CASE("an interpolant has the function's value at each dof, ghosts too") {
  const mesh::Mesh mesh = box();
  for (const int degree : {1, 2}) {
    const fem::Space space = fem::lagrange(mesh, degree);
    fem::Field field = fem::interpolate(space, 2, [](std::span<const double> x, std::span<double> u) {
      u[0] = x[0] + 10 * x[1] + 100 * x[2];
      u[1] = -x[0];
    });
    const auto points = fem::dof_points(space);
    bool exact = true;
    for (std::int32_t i = 0; i < space.num_dofs(); ++i) {
      const double* x = points.data() + 3 * i;
      exact = exact && field.at(i)[0] == x[0] + 10 * x[1] + 100 * x[2] && field.at(i)[1] == -x[0];
    }
    CHECK(exact);
    const auto before = field.values;
    for (std::int32_t i = space.dofs.num_owned; i < space.num_dofs(); ++i) field.at(i)[0] = std::nan("");
    field.copy_to_ghosts();
    CHECK(field.values == before);
  }
}
