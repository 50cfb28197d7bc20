#include "coupling/analogies/force_source.hpp"

#include <cmath>
#include <utility>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/made_flow.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using test::MadeFlow;
using test::Point;

namespace {

/// Fluid for x < 1, air for 1 < x < 1.5, of height ½ (and depth ½).
std::unique_ptr<Scene> channel(int dimension) {
  const auto kind = [](const Point& centre) { return centre[0] < 1 ? RegionKind::fluid : RegionKind::air; };
  return dimension == 2 ? test::box_scene({1.5, 0.5, 0}, {9, 4, 0}, kind)
                        : test::box_scene({1.5, 0.5, 0.5}, {9, 4, 4}, kind);
}

/// Inner vertices move, and those of the wall x = 0 along it.
const auto inner_motion = [](const Point& x, double t) {
  return Point{0.1 * t * std::pow(std::sin(M_PI * x[0]), 2), 0.2 * t * std::sin(2 * M_PI * x[1]), 0};
};
const auto no_pressure = [](const Point&, double) { return 0.0; };
/// Of no symmetry.
Point wild(const Point& x, double t) {
  return {std::sin(7 * x[0] + 3 * x[1] + t) + 0.3, std::cos(5 * x[0] * x[1] + 2 * x[2]) - t, std::sin(9 * x[2] + x[1])};
}

struct OneStep {
  OneStep(const Scene& scene, const MadeFlow& flow, double dt) : history(scene, 2, false) {
    history.restart(test::snapshot(scene, flow, 0));
    history.add(test::snapshot(scene, flow, dt));
    view = history.step(PressureDerivative::step).view;
  }
  FlowHistory history;
  FlowView view;
};

/// Σ_k x_k^axis load_k over all ranks; axis -1: Σ load_k.
double moment(const FlowView& flow, const fem::Load& load, int axis) {
  const int d = flow.space->mesh->dimension;
  double sum = 0;
  for (std::size_t v = 0; v < load.values.size(); ++v) {
    sum += load.values[v] * (axis < 0 ? 1 : flow.coordinates_middle[v * d + axis]);
  }
  return base::sum(MPI_COMM_WORLD, sum);
}

/// `wild` in the middles of edges.
std::vector<double> wild_edges(const FlowView& flow) {
  const mesh::Mesh& mesh = *flow.space->mesh;
  const int d = mesh.dimension;
  std::vector<double> result;
  for (std::int32_t e = 0; e < mesh.edges.num_local(); ++e) {
    Point middle = {0, 0, 0};
    for (int k = 0; k < d; ++k) {
      for (int end = 0; end < 2; ++end) {
        middle[k] += 0.5 * flow.coordinates_middle[static_cast<std::size_t>(mesh.edge_vertices[2 * e + end]) * d + k];
      }
    }
    const Point u = wild(middle, 0.05);
    result.insert(result.end(), u.begin(), u.begin() + d);
  }
  return result;
}

/// ∫ u_axis u·n ds over the whole rim of the fluid, u u interpolated between vertices, and middles of edges if given.
double flux_through_rim(Scene& scene, const FlowView& flow, const std::vector<double>& velocity,
                        const std::vector<double>& of_edges, int axis) {
  mesh::Mesh& mesh = scene.flow->mesh;
  const std::vector<double> at_rest = std::exchange(mesh.coordinates, flow.coordinates_middle);
  const int d = mesh.dimension;
  const auto edges = mesh::edges_of_cell(d);
  const double of_vertex = of_edges.empty() ? 1.0 / d : (d == 2 ? 1.0 / 6 : 0), of_edge = d == 2 ? 4.0 / 6 : 1.0 / 3;
  double sum = 0;
  for (const auto* facets : {&flow.walls, &flow.outlet}) {
    for (const mesh::NamedFacet& facet : *facets) {
      const auto geometry = mesh::facet_geometry(mesh, facet.cell, facet.index);
      const auto add = [&](const double* u, double weight) {
        double through = 0;
        for (int k = 0; k < d; ++k) through += u[k] * geometry.normal[k];
        sum += u[axis] * through * geometry.measure * weight;
      };
      const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
      for (int i = 0; i < d; ++i) add(velocity.data() + static_cast<std::size_t>(corners[i]) * d, of_vertex);
      for (std::size_t e = 0; !of_edges.empty() && e < edges.size(); ++e) {
        if (edges[e][0] == facet.index || edges[e][1] == facet.index) continue;
        add(of_edges.data() + static_cast<std::size_t>(mesh.cell_edges[facet.cell * edges.size() + e]) * d, of_edge);
      }
    }
  }
  mesh.coordinates = at_rest;
  return base::sum(MPI_COMM_WORLD, sum);
}

fem::Load carried(const FlowView& flow, CarriedMomentum which, const std::vector<double>& velocity,
                  const std::vector<double>& of_edges, const std::vector<double>& window = {}) {
  fem::Load load(*flow.space, 1);
  const AnalogyMedium medium = {.density = 1.2, .speed_of_sound = 340, .window = window};
  add_carried_momentum(flow, medium, which, velocity, of_edges, load);
  return load;
}

}  // namespace

TEST_CASE("carried momentum is no volume, and its force is what flows through the rim") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const OneStep step(*scene, {no_pressure, wild, inner_motion}, 0.1);
    for (const auto& of_edges : {std::vector<double>(), wild_edges(step.view)}) {
      const auto& velocity = step.view.velocity_end;
      const fem::Load load = carried(step.view, CarriedMomentum::whole, velocity, of_edges);
      CHECK(moment(step.view, load, -1) == Approx(0).margin(1e-12));
      for (int k = 0; k < d; ++k) {
        const double flux = flux_through_rim(*scene, step.view, velocity, of_edges, k);
        CHECK(std::abs(flux) > 1e-3);
        CHECK(moment(step.view, load, k) == Approx(-flux).margin(1e-12));
      }
    }
  }
}

TEST_CASE("what a window keeps inside the flow has no force at all") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const OneStep step(*scene, {no_pressure, wild, inner_motion}, 0.1);
    const mesh::Mesh& mesh = scene->flow->mesh;
    std::vector<double> window;
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      double weight = 1;
      for (int k = 0; k < d; ++k) weight *= std::max(0.0, std::sin(M_PI * mesh.point(v)[k] / (k == 0 ? 1 : 0.5)));
      window.push_back(weight < 1e-12 ? 0 : weight);
    }
    for (const auto which : {CarriedMomentum::whole, CarriedMomentum::lamb}) {
      const fem::Load load = carried(step.view, which, step.view.velocity_end, wild_edges(step.view), window);
      CHECK(moment(step.view, load, -1) == Approx(0).margin(1e-12));
      for (int k = 0; k < d; ++k) CHECK(moment(step.view, load, k) == Approx(0).margin(1e-12));
      double largest = 0;
      for (const double value : load.values) largest = std::max(largest, std::abs(value));
      CHECK(base::largest(MPI_COMM_WORLD, largest) > 1e-3);
    }
  }
}

TEST_CASE("the Lamb vector is the carried momentum less the gradient of half the square of the speed") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const auto difference = [&](const std::function<Point(const Point&, double)>& velocity) {
      const OneStep step(*scene, {no_pressure, velocity, {}}, 0.1);
      fem::Load load = carried(step.view, CarriedMomentum::whole, step.view.velocity_begin, {});
      const fem::Load lamb = carried(step.view, CarriedMomentum::lamb, step.view.velocity_begin, {});
      for (std::size_t v = 0; v < load.values.size(); ++v) load.values[v] -= lamb.values[v];
      return std::pair(load, moment(step.view, load, 0));
    };
    // It depends on the speed alone, whatever the direction is ...
    const auto speed = [](const Point& x) { return std::sqrt(1 + 6 * x[0]); };
    const auto [along, force] = difference([&](const Point& x, double) { return Point{speed(x), 0, 0}; });
    const auto [turned, other] = difference([&](const Point& x, double) {
      const double angle = 40 * x[0] + 90 * x[1];
      return Point{speed(x) * std::cos(angle), speed(x) * std::sin(angle), 0};
    });
    for (std::size_t v = 0; v < along.values.size(); ++v) {
      CHECK(along.values[v] == Approx(turned.values[v]).margin(1e-13));
    }
    // ... and where |u|² = 1 + 6 x it is the force -3 on each unit of volume.
    CHECK(force == Approx(-3 * (d == 2 ? 0.5 : 0.25)).epsilon(1e-12));
  }
}

TEST_CASE("walls that speed up push the air, the outlet does not") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const double area = d == 2 ? 0.5 : 0.25, acceleration = 30;
    // On a mesh that moves, the flow's acceleration is that at a fixed point: u = (30 t + 2 x, -2 y).
    const auto velocity = [&](const Point& x, double t) { return Point{acceleration * t + 2 * x[0], -2 * x[1], 0}; };
    for (const auto& motion : {std::function<Point(const Point&, double)>(), {inner_motion}}) {
      const OneStep step(*scene, {no_pressure, velocity, motion}, 0.1);
      fem::Load load(*step.view.space, 1);
      add_wall_acceleration(step.view, load);
      // n = -x at the wall x = 0, the only one that is not parallel to x.
      CHECK(moment(step.view, load, -1) == Approx(acceleration * area).epsilon(1e-12));
      CHECK(moment(step.view, load, 0) == Approx(0).margin(1e-12));
    }
  }
}
