#include "coupling/monitors/probe.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// A unit square with cells of size 0.25 whose lower edge bulges: the middles of its edges are at y = -0.02.
struct Bulge {
  mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {4, 4, 0}));
  fem::Space space = fem::lagrange(mesh, 2);
  std::vector<double> points = fem::dof_points(space);
  std::vector<std::int32_t> everywhere = std::vector<std::int32_t>(mesh.num_cells(), 1);

  Bulge() {
    for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
      if (space.dof_vertex[dof] < 0 && points[2 * dof + 1] == 0) points[2 * dof + 1] = -0.02;
    }
  }
  /// The position itself, as the space has it.
  std::vector<double> position_at(const Probe& probe) const {
    fem::Field field(space, 2);
    field.values = points;
    return value_at(field, probe);
  }
};

}  // namespace

TEST_CASE("a point in the bulge of a curved boundary is found inside its cell") {
  const Bulge bulge;
  for (const fem::Point& point :
       {fem::Point{0.625, -0.0199, 0}, fem::Point{0.1, -0.01, 0}, fem::Point{0.3, 0.6, 0}, fem::Point{1, 1, 0}}) {
    const Probe probe = find_probe(bulge.space, bulge.points, point, bulge.everywhere);
    REQUIRE_ON_ALL_RANKS(probe.rank >= 0);
    if (base::rank(MPI_COMM_WORLD) == probe.rank) {
      CHECK(*std::min_element(probe.coordinates.begin(), probe.coordinates.begin() + 3) > -1e-9);
    }
    const std::vector<double> position = bulge.position_at(probe);
    REQUIRE_ON_ALL_RANKS(position.size() == 2);
    for (int k = 0; k < 2; ++k) CHECK(position[k] == Approx(point[k]).margin(1e-12));
  }
}

TEST_CASE("a point is forgiven less than a tenth of a cell outside, not more") {
  const Bulge bulge;
  CHECK(find_probe(bulge.space, bulge.points, {0.5, 1.02, 0}, bulge.everywhere).rank >= 0);
  CHECK(find_probe(bulge.space, bulge.points, {0.5, 1.03, 0}, bulge.everywhere).rank == -1);
  CHECK(find_probe(bulge.space, bulge.points, {3, 3, 0}, bulge.everywhere).rank == -1);
}

TEST_CASE("a point is looked for in the marked cells only") {
  Bulge bulge;
  for (std::int32_t cell = 0; cell < bulge.mesh.num_cells(); ++cell) {
    for (const std::int32_t v : bulge.mesh.vertices_of(cell)) {
      if (bulge.mesh.point(v)[0] > 0.5) bulge.everywhere[cell] = 0;
    }
  }
  CHECK(find_probe(bulge.space, bulge.points, {0.5, 0.6, 0}, bulge.everywhere).rank >= 0);
  CHECK(find_probe(bulge.space, bulge.points, {0.6, 0.6, 0}, bulge.everywhere).rank == -1);
}
