#include "contact/closed_cells.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::contact {
namespace {

/// The first of the nearest ones, by looking at every one.
ClosedCells::Nearest nearest_of_all(const ClosedCells& cells, const std::array<double, 3>& place) {
  ClosedCells::Nearest result;
  for (std::size_t i = 0; i < cells.count(); ++i) {
    double square = 0;
    for (int k = 0; k < cells.dimension; ++k) {
      const double way = cells.middles[i * cells.dimension + k] - place[k];
      square += way * way;
    }
    if (square < result.square) result = {i, square};
  }
  return result;
}

void check_nearest(const std::array<int, 3>& shape, const std::array<double, 3>& size) {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, size, shape));
  const std::vector<double> normal(static_cast<std::size_t>(mesh.num_cells()) * mesh.dimension, 1);
  std::vector<double> closing_gap(mesh.num_cells(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); cell += 3) closing_gap[cell] = 1;
  const ClosedCells closed = gather_closed(mesh, mesh.coordinates, closing_gap, normal);
  REQUIRE(closed.count() > 20);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-0.2, 1.2);
  for (int n = 0; n < 300; ++n) {
    std::array<double, 3> place = {share(random) * size[0], share(random) * size[1], share(random) * size[2]};
    if (n % 3 == 0) place = {0.5 * size[0], 0.5 * size[1], 0.5 * size[2]};  // as near to several
    if (n % 3 == 0) place[n / 3 % mesh.dimension] *= share(random);
    const auto found = closed.nearest(place), expected = nearest_of_all(closed, place);
    CHECK(found.index == expected.index);
    CHECK(found.square == expected.square);
  }
}

}  // namespace

TEST_CASE("The nearest closed cell is the first of the nearest of all") {
  check_nearest({20, 4, 0}, {2, 0.4, 0});
  check_nearest({3, 14, 0}, {0.3, 2, 0});
  check_nearest({4, 4, 4}, {1, 1, 2});
}

TEST_CASE("Where no cell is closed the nearest is infinitely far") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {4, 4, 0}));
  const std::vector<double> none(mesh.num_cells(), 0), normal(static_cast<std::size_t>(mesh.num_cells()) * 2, 0);
  const ClosedCells closed = gather_closed(mesh, mesh.coordinates, none, normal);
  CHECK(std::isinf(closed.nearest({0.5, 0.5, 0}).square));
}

}  // namespace vocalis::contact
