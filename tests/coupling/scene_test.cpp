#include "coupling/scene.hpp"

#include <cmath>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// Fluid left of x = 1 with a solid block on its floor, air right of it; the block touches the air.
RegionKind kind_at(const std::array<double, 3>& centre) {
  if (centre[0] > 1) return RegionKind::air;
  return centre[0] > 0.5 && centre[1] < 0.25 ? RegionKind::solid : RegionKind::fluid;
}

}  // namespace

TEST_CASE("each solver's mesh has its regions' cells, once over all ranks") {
  const auto scene = test::box_scene({2, 1, 0}, {8, 4, 0}, kind_at);
  CHECK(scene->parent.cells.num_global == 64);
  CHECK(scene->flow->mesh.cells.num_global == 32);
  CHECK(scene->acoustic->mesh.cells.num_global == 60);
  std::int64_t fluid = 0;
  for (const std::int32_t is_fluid : fluid_cells(*scene)) fluid += is_fluid;
  CHECK(base::sum(MPI_COMM_WORLD, fluid) == 28);
}

TEST_CASE("the outlet is where fluid ends at air, with normals out of the flow; a solid there is no outlet") {
  for (const int d : {2, 3}) {
    const auto scene =
        d == 2 ? test::box_scene({2, 1, 0}, {8, 4, 0}, kind_at) : test::box_scene({2, 1, 1}, {4, 4, 2}, kind_at);
    double measure = 0;
    bool points_right = true, is_at_end = true;
    for (const mesh::NamedFacet& facet : flow_outlet(*scene)) {
      const auto geometry = mesh::facet_geometry(scene->flow->mesh, facet.cell, facet.index);
      measure += geometry.measure;
      points_right = points_right && std::abs(geometry.normal[0] - 1) < 1e-12;
      for (int i = 0; i < d; ++i) {
        const std::int32_t corner = mesh::facet_vertices(scene->flow->mesh, facet.cell, facet.index)[i];
        is_at_end = is_at_end && scene->flow->mesh.point(corner)[0] == 1;
      }
    }
    CHECK(points_right);
    CHECK(is_at_end);
    CHECK(base::sum(MPI_COMM_WORLD, measure) == Approx(0.75));
  }
}

TEST_CASE("a flow without air behind it has no outlet into the air") {
  const auto scene = test::box_scene({1, 1, 0}, {3, 3, 0}, [](const auto&) { return RegionKind::fluid; });
  CHECK(flow_outlet(*scene).empty());
}
