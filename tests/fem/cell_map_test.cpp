#include "core/fem/cell_map.hpp"

#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::fem;

namespace {

/// Where the dofs are when the box is bent and pressed, by polynomials of degree 2.
std::vector<double> bent(const fem::Space& space) {
  const std::size_t d = static_cast<std::size_t>(space.mesh->dimension);
  std::vector<double> points = fem::dof_points(space);
  for (std::size_t i = 0; i < points.size(); i += d) {
    double* x = points.data() + i;
    const double first = x[0], last = x[d - 1];
    x[0] += 0.1 * last * last;
    x[1] = 0.8 * x[1] + 0.15 * first * first;
  }
  return points;
}

}  // namespace

TEST_CASE("a point of a bent cell is found again by its coordinates") {
  for (const int d : {2, 3}) {
    const mesh::Mesh mesh =
        mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1e-3, 1e-3, d == 2 ? 0 : 1e-3}, {3, 3, 3}));
    for (const int degree : {1, 2}) {
      const fem::Space space = fem::lagrange(mesh, degree);
      std::vector<double> points = bent(space);
      double largest = 0;
      for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
        const CellMap map(space, points, cell);
        for (const Barycentric& wanted :
             {Barycentric{0.2, 0.3, 0.5, 0}, Barycentric{1, 0, 0, 0}, Barycentric{-0.05, 0.6, 0.45, 0}}) {
          const auto found = map.coordinates_of(map.at(wanted));
          CHECK(found.has_value());
          for (int i = 0; found && i <= d; ++i) largest = std::max(largest, std::abs((*found)[i] - wanted[i]));
        }
      }
      CHECK(largest < 1e-10);
    }
  }
}

TEST_CASE("the map's derivatives are its differences") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {2, 2, 0}));
  const fem::Space space = fem::lagrange(mesh, 2);
  const std::vector<double> points = bent(space);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const CellMap map(space, points, cell);
    const auto derivatives = map.derivatives({0.2, 0.3, 0.5, 0});
    for (int i = 0; i < 3; ++i) {
      Barycentric ahead = {0.2, 0.3, 0.5, 0}, behind = ahead;
      ahead[i] += 1e-4, behind[i] -= 1e-4;
      for (int k = 0; k < 2; ++k) {
        CHECK(derivatives[i][k] == Approx((map.at(ahead)[k] - map.at(behind)[k]) / 2e-4).margin(1e-9));
      }
    }
  }
}

TEST_CASE("a point far away from a cell has no coordinates in it") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {4, 4, 0}));
  const fem::Space space = fem::lagrange(mesh, 2);
  const std::vector<double> points = fem::dof_points(space);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    CHECK_FALSE(CellMap(space, points, cell).coordinates_of({100, 3, 0}).has_value());
  }
}
