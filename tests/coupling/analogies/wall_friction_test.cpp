#include "coupling/analogies/wall_friction.hpp"

#include "core/base/mpi.hpp"
#include "coupling/analogies/flow_cell.hpp"
#include "coupling/analogies/lighthill.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/made_flow.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using test::Point;

namespace {

constexpr double nu = 0.3;
using Velocity = std::function<Point(const Point&)>;

/// One step of a steady flow in a box, 1 long, ½ high (and deep), with air behind it as far as `length`.
struct SteadyFlow {
  SteadyFlow(int d, double length, const Velocity& velocity)
      : scene(test::box_scene({length, 0.5, d == 2 ? 0 : 0.5}, {static_cast<int>(6 * length), 4, d == 2 ? 0 : 3},
                              [](const Point& x) { return x[0] < 1 ? RegionKind::fluid : RegionKind::air; })),
        history(*scene, 2, false) {
    const test::MadeFlow flow = {
        [](const Point&, double) { return 0.0; }, [&](const Point& x, double) { return velocity(x); }, {}};
    for (const double time : {0.0, 0.1}) history.add(test::snapshot(*scene, flow, time));
    view = history.step(PressureDerivative::step).view;
    const mesh::Mesh& mesh = scene->flow->mesh;
    for (std::int32_t e = 0; e < mesh.edges.num_local(); ++e) {
      Point middle = {0, 0, 0};
      for (int end = 0; end < 2; ++end) {
        for (int k = 0; k < d; ++k) middle[k] += 0.5 * mesh.point(mesh.edge_vertices[2 * e + end])[k];
      }
      const Point u = velocity(middle);
      edges.insert(edges.end(), u.begin(), u.begin() + d);
    }
  }
  /// Whole at the owners.
  fem::Load friction(const std::vector<double>& of_edges, const std::vector<double>& window = {}) const {
    fem::Load load(*view.space, 1);
    add_wall_friction(view, {.density = 1.2, .speed_of_sound = 340, .window = window, .kinematic_viscosity = nu},
                      view.velocity_end, of_edges, load);
    view.space->halo.add_to_owners(load.values);
    return load;
  }
  /// Σ_k x_k^axis load_k over all ranks; axis -1: Σ load_k.
  double moment(const fem::Load& load, int axis) const {
    const mesh::Mesh& mesh = scene->flow->mesh;
    double sum = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      sum += load.values[v] * (axis < 0 ? 1 : mesh.point(v)[axis]);
    }
    return base::sum(MPI_COMM_WORLD, sum);
  }
  std::unique_ptr<Scene> scene;
  FlowHistory history;
  FlowView view;
  std::vector<double> edges;  ///< (edges, d) u in their middles
};

/// Of no symmetry, with div u = 0 and a constant curl ω = -Δu.
Point quadratic(const Point& x) {
  return {2 * x[1] * x[1] - 3 * x[2] * x[1] + x[0] * x[1] + x[2], x[0] * x[0] - 0.5 * x[1] * x[1] + 4 * x[2] * x[2],
          5 * x[0] * x[1] - x[0] * x[0]};
}
Point curl_of_vorticity(int d) { return {-4, d == 2 ? -1.0 : -9.0, 2}; }

/// Along x between y = 0 and y = ½, ∂u/∂y = ±½ there.
Point between_plates(const Point& x) { return {x[1] * (0.5 - x[1]), 0, 0}; }

double depth(int d) { return d == 2 ? 1 : 0.5; }

}  // namespace

TEST_CASE("friction at the walls is to sound what the viscous force is in the volume") {
  for (const int d : {2, 3}) {
    const SteadyFlow flow(d, 1, quadratic);  // walls all round
    const fem::Load load = flow.friction(flow.edges);
    fem::Load expected(*flow.view.space, 1);
    const auto add = [&]<int Dimension>(std::integral_constant<int, Dimension>) {
      const mesh::Mesh& mesh = flow.scene->flow->mesh;
      for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
        const auto geometry = geometry_of_cell<Dimension>(flow.view, mesh.vertices_of(cell));
        for (int i = 0; i <= d; ++i) {
          for (int k = 0; k < d; ++k) {
            expected.values[mesh.vertices_of(cell)[i]] -=
                nu * curl_of_vorticity(d)[k] * geometry.measure * geometry.gradient[i][k];
          }
        }
      }
    };
    if (d == 2) add(std::integral_constant<int, 2>());
    if (d == 3) add(std::integral_constant<int, 3>());
    flow.view.space->halo.add_to_owners(expected.values);
    for (std::int32_t v = 0; v < flow.view.space->dofs.num_owned; ++v) {
      CHECK(load.values[v] == Approx(expected.values[v]).margin(1e-13));
    }
    for (int k = 0; k < d; ++k) {
      CHECK(flow.moment(load, k) == Approx(-nu * curl_of_vorticity(d)[k] * 0.5 * depth(d)).epsilon(1e-11));
    }
  }
}

TEST_CASE("its force is that of the walls on the fluid, and the outlet into the air has none") {
  for (const int d : {2, 3}) {
    const SteadyFlow flow(d, 1.5, between_plates);
    const fem::Load load = flow.friction(flow.edges);
    CHECK(flow.moment(load, -1) == Approx(0).margin(1e-13));
    CHECK(flow.moment(load, 0) == Approx(-nu * 0.5 * 2 * depth(d)).epsilon(1e-11));  // ν ∂u/∂n on both plates
    CHECK(flow.moment(load, 1) == Approx(0).margin(1e-13));
    // Of a linear velocity by the slope of the cell at the plate, ½ - h.
    CHECK(flow.moment(flow.friction({}), 0) == Approx(-nu * (0.5 - 0.125) * 2 * depth(d)).epsilon(1e-11));
  }
}

TEST_CASE("a window weighs friction, cells with a silent vertex and air without viscosity have none") {
  SteadyFlow flow(2, 1.5, between_plates);
  const std::size_t vertices = flow.view.space->dofs.num_local();
  const double whole = flow.moment(flow.friction(flow.edges), 0);
  CHECK(flow.moment(flow.friction(flow.edges, std::vector<double>(vertices, 0.25)), 0) == Approx(0.25 * whole));
  flow.view.edges_begin = flow.view.edges_end = flow.edges;
  const auto of_lighthill = [&](double viscosity) {
    fem::Load load = Lighthill({1.2, 340, {}, viscosity}).source(flow.view).end;
    flow.view.space->halo.add_to_owners(load.values);
    return flow.moment(load, 0);
  };
  CHECK(of_lighthill(nu) - of_lighthill(0) == Approx(whole));
  flow.view.vertex_is_silent.assign(vertices, 0);
  for (std::size_t v = 0; v < vertices; ++v) flow.view.vertex_is_silent[v] = flow.scene->flow->mesh.point(v)[0] < 0.4;
  CHECK(flow.moment(flow.friction(flow.edges), 0) == Approx(0.5 * whole));
}
