#include "core/mesh/locate.hpp"

#include <array>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

TEST_CASE("a point is found by one rank, and its barycentric coordinates give it back") {
  for (const double depth : {0.0, 1.0}) {
    const mesh::Mesh box = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, depth}, {4, 3, 2}));
    for (const std::array<double, 3> point :
         {std::array<double, 3>{0.123, 0.456, 0.5 * depth}, std::array<double, 3>{0.5, 1.0 / 3, 0.5 * depth},
          std::array<double, 3>{0, 0, 0}, std::array<double, 3>{1, 1, depth}}) {
      const mesh::Location location = mesh::locate(box, point);
      const auto ranks = base::gather_all(MPI_COMM_WORLD, location.rank);
      for (const int rank : ranks) CHECK(rank == location.rank);
      REQUIRE_ON_ALL_RANKS(location.rank >= 0);
      if (location.rank != base::rank(MPI_COMM_WORLD)) continue;
      std::array<double, 3> found = {0, 0, 0};
      for (int i = 0; i <= box.dimension; ++i) {
        CHECK(location.barycentric[i] > -1e-9);
        for (int k = 0; k < box.dimension; ++k) {
          found[k] += location.barycentric[i] * box.point(box.vertices_of(location.cell)[i])[k];
        }
      }
      for (int k = 0; k < box.dimension; ++k) CHECK(found[k] == Approx(point[k]).margin(1e-12));
    }
    CHECK(mesh::locate(box, {1.001, 0.5, 0.5 * depth}).rank == -1);
    CHECK(mesh::locate(box, {-5, 0.5, 0}).rank == -1);
  }
}
