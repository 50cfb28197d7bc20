#include "coupling/voice/flow_bridge.hpp"

#include <numeric>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "coupling/voice/air.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// A duct of fluid with a solid block on its floor.
std::unique_ptr<Scene> duct() {
  return test::box_scene({1, 1, 0}, {8, 8, 0}, [](const auto& centre) {
    return centre[0] > 0.5 && centre[1] < 0.25 ? RegionKind::solid : RegionKind::fluid;
  });
}

mesh::Mesh box(double length, int cells) {
  return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {length, 1, 0}, {cells, 5, 0}));
}

double total(const fem::Load& load) {
  const double here = std::accumulate(load.values.begin(), load.values.end(), 0.0);
  return base::sum(load.space->mesh->comm, here);
}

}  // namespace

TEST_CASE("a bridge keeps the total of the fluid's loads and brings linear values where there is flow") {
  const auto scene = duct();
  const mesh::Mesh air = box(2, 9);
  const FlowBridge bridge(*scene, air, {}, "sound");
  CHECK(bridge.outside().count == 0);
  const fem::Space flow_space = fem::lagrange(scene->flow->mesh, 1), space = fem::lagrange(air, 1);
  fem::Load given(flow_space, 1), received(space, 1);
  const mesh::Mesh& flow = scene->flow->mesh;
  const std::vector<std::int32_t> is_fluid = fluid_cells(*scene);
  for (std::int32_t cell = 0; cell < flow.num_cells(); ++cell) {
    for (const std::int32_t v : flow.vertices_of(cell)) given.values[v] += is_fluid[cell] ? 0.1 + flow.point(v)[0] : 0;
  }
  bridge.carry(given, received);
  CHECK(total(received) == Approx(total(given)).epsilon(1e-13));

  std::vector<double> values;
  for (std::int32_t v = 0; v < flow.num_vertices(); ++v) values.push_back(1 + flow.point(v)[0] - 2 * flow.point(v)[1]);
  const std::vector<double> there = bridge.values(values, 1);
  const std::vector<std::int32_t> in_flow = bridge.cells_in_flow(air);
  std::int64_t cells = 0;
  for (std::int32_t cell = 0; cell < air.num_cells(); ++cell) {
    cells += in_flow[cell];
    for (const std::int32_t v : air.vertices_of(cell)) {
      const double x = air.point(v)[0], y = air.point(v)[1];
      const bool is_within = x < 1 && (x < 0.5 || y > 0.25);
      if (is_within) CHECK(there[v] == Approx(1 + x - 2 * y).margin(1e-12));
      if (x > 1.3) CHECK(there[v] == 0);
      if (x > 1.3) CHECK(in_flow[cell] == 0);
    }
  }
  CHECK(base::sum(MPI_COMM_WORLD, cells) > 20);
  CHECK(base::sum(MPI_COMM_WORLD, cells) < 60);
  for (const double value : bridge.values({}, 2)) CHECK(value == 0);
}

TEST_CASE("a flow that ends inside of air on another mesh has its outlet there, and no wall") {
  const auto scene = duct();
  const mesh::Mesh air = box(2, 9);
  FlowView view;
  view.walls = flow_walls(*scene);
  view.outlet = flow_outlet(*scene);
  const auto count = [](const std::vector<mesh::NamedFacet>& facets) {
    return base::sum(MPI_COMM_WORLD, static_cast<std::int64_t>(facets.size()));
  };
  CHECK(count(view.outlet) == 0);
  const std::int64_t walls = count(view.walls);
  CHECK(!FlowBridge(*scene, air, {}, "sound").with_ends(view));
  // Of the eight facets at x = 1 two are the block's.
  const auto seen = FlowBridge(*scene, air, {"right"}, "sound").with_ends(view);
  CHECK(count(seen ? seen->outlet : view.outlet) == 6);
  CHECK(count(seen ? seen->walls : view.walls) == walls - 6);
}

TEST_CASE(
    "air on a mesh of its own stands still, or follows the flow where there is one, and tells of cells turned over") {
  const auto scene = duct();
  Air air;
  air.is_separate = true;
  air.own = std::make_unique<transfer::StrippedMesh>();
  air.own->mesh = box(2, 9);
  air.stripped = air.own.get();
  air.rest_coordinates = air.mesh().coordinates;
  air.bridge = std::make_unique<FlowBridge>(*scene, air.mesh(), std::vector<std::string>(), "sound");
  const fem::Space flow_space = fem::lagrange(scene->flow->mesh, 1), space = fem::lagrange(air.mesh(), 1);
  const auto pushed =
      [&](double slope) {  // (slope (1 - x), 0.1 y): nothing moves at x = 1, where the flow ends, along x
        fem::Field displacement(flow_space, 2);
        for (std::int32_t v = 0; v < flow_space.num_dofs(); ++v) {
          const double* x = scene->flow->mesh.point(v);
          displacement.at(v)[0] = slope * (1 - x[0]);
          displacement.at(v)[1] = 0.1 * x[1];
        }
        return displacement;
      };
  CHECK(moved_coordinates(air, space, pushed(0.3)) == air.rest_coordinates);
  CHECK(keeps_its_cells(air, moved_coordinates(air, space, pushed(-1.5))));
  air.follows = true;
  const std::vector<double> moved = moved_coordinates(air, space, pushed(0.3));
  for (std::int32_t v = 0; v < air.mesh().num_vertices(); ++v) {
    const double x = air.rest_coordinates[2 * v], y = air.rest_coordinates[2 * v + 1];
    if (x < 1 && (x < 0.5 || y > 0.25)) {
      CHECK(moved[2 * v] == Approx(x + 0.3 * (1 - x)));
      CHECK(moved[2 * v + 1] == Approx(1.1 * y).margin(1e-12));
    }
    if (x > 1.3) CHECK(moved[2 * v] == x);
    if (x > 1.3) CHECK(moved[2 * v + 1] == y);
  }
  CHECK(keeps_its_cells(air, moved));
  CHECK(!keeps_its_cells(air, moved_coordinates(air, space, pushed(1.5))));
}

TEST_CASE("a flow that reaches out of the other mesh is the user's mistake") {
  const auto scene = duct();
  const mesh::Mesh air = box(0.4, 4);
  CHECK_THROWS_AS(FlowBridge(*scene, air, {}, "sound"), base::UserError);
}
