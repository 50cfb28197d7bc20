#include "coupling/analogies/pressure_rate.hpp"

#include <cmath>
#include <functional>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

constexpr double density = 1.2, speed = 340;
const AnalogyMedium medium = {.density = density, .speed_of_sound = speed, .window = {}};
using Point = std::array<double, 3>;

/// Fluid for x < 1, air for 1 < x < 2, of height ½ (and depth ½).
std::unique_ptr<Scene> channel(int dimension) {
  const auto kind = [](const Point& centre) { return centre[0] < 1 ? RegionKind::fluid : RegionKind::air; };
  return dimension == 2 ? test::box_scene({2, 0.5, 0}, {12, 3, 0}, kind)
                        : test::box_scene({2, 0.5, 0.5}, {6, 2, 2}, kind);
}
double volume(int dimension) { return dimension == 2 ? 0.5 : 0.25; }

/// A flow given by formulas: pressure(x, t), velocity(x, t) where the moved mesh is; x = X + t motion(X), t from 0 to
/// dt.
struct FakeFlow {
  FakeFlow(const Scene& scene, const std::function<double(const Point&, double)>& pressure,
           const std::function<Point(const Point&, double)>& velocity, const std::function<Point(const Point&)>& motion,
           double dt)
      : space(fem::lagrange(scene.flow->mesh, 1)), is_fluid(fluid_cells(scene)) {
    const mesh::Mesh& mesh = scene.flow->mesh;
    const int d = mesh.dimension;
    view.space = &space;
    view.time_end = dt;
    view.cell_is_fluid = is_fluid;
    view.outlet = flow_outlet(scene);
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      Point rest = {0, 0, 0};
      std::copy_n(mesh.point(v), d, rest.begin());
      const Point beta = motion(rest);
      Point end = rest;
      for (int k = 0; k < d; ++k) end[k] += dt * beta[k];
      view.pressure_begin.push_back(pressure(rest, 0));
      view.pressure_end.push_back(pressure(end, dt));
      for (int k = 0; k < d; ++k) {
        view.coordinates_middle.push_back(0.5 * (rest[k] + end[k]));
        view.mesh_velocity.push_back(beta[k]);
        view.velocity_begin.push_back(velocity(rest, 0)[k]);
        view.velocity_end.push_back(velocity(end, dt)[k]);
      }
    }
  }
  fem::Space space;
  std::vector<std::int32_t> is_fluid;
  FlowView view;
};

const auto still = [](const Point&) { return Point{0, 0, 0}; };
const auto at_rest = [](const Point&, double) { return Point{0, 0, 0}; };
/// Vanishes on the boundary of the fluid in x; shifts inner vertices, so that cells change and the whole does not.
const auto inner_motion = [](const Point& x) {
  const double bump = std::sin(M_PI * x[0]);
  return Point{0.3 * bump * bump, 0, 0};
};

double total(const fem::Load& load) {
  double sum = 0;
  for (const double value : load.values) sum += value;
  return base::sum(load.space->mesh->comm, sum);
}

double largest(const fem::Load& load) {
  double result = 0;
  for (const double value : load.values) result = std::max(result, std::abs(value));
  return base::largest(load.space->mesh->comm, result);
}

}  // namespace

TEST_CASE("pressure that rises at a fixed point takes volume away: the source has the minus sign", "[serial]") {
  CHECK(pressure_source_density(100, 0, medium) == Approx(-100 / (density * speed * speed)));
  CHECK(pressure_source_density(0, 100, medium) == Approx(100 / (density * speed * speed)));
  CHECK(pressure_source_density(7, 7, medium) == 0);
}

TEST_CASE("the names of the analogies make analogies, others are refused") {
  for (const std::string& name : analogy_names()) CHECK(make_analogy({.name = name, .mean_time = 1}, medium));
  CHECK_THROWS_AS(make_analogy({.name = "lighthil"}, medium), base::UserError);
}

TEST_CASE("a pressure that rises evenly gives -V / (rho c^2) times its rate") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const double rate = 250, dt = 1e-3;
    const FakeFlow flow(
        *scene, [&](const Point&, double t) { return 40 + rate * t; }, at_rest, still, dt);
    const AnalogySource source = PressureRate(medium).source(flow.view);
    const double expected = -volume(d) * rate / (density * speed * speed);
    CHECK(total(source.begin) == Approx(expected).epsilon(1e-12));
    CHECK(total(source.end) == Approx(expected).epsilon(1e-12));
    // The same where vertices move, and the volume does not.
    const FakeFlow moving(
        *scene, [&](const Point&, double t) { return 40 + rate * t; }, at_rest, inner_motion, dt);
    CHECK(total(PressureRate(medium).source(moving.view).end) == Approx(expected).epsilon(1e-10));
  }
}

TEST_CASE("a steady flow makes no sound in the volume, on a moving mesh neither") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const auto uniform = [](const Point&, double) { return 1000.0; };
    const auto linear = [](const Point& x, double) { return 1000 - 300 * x[0] + 20 * x[1]; };
    for (const auto& pressure : {std::function<double(const Point&, double)>(uniform), {linear}}) {
      const FakeFlow still_flow(*scene, pressure, at_rest, still, 1e-3);
      CHECK(largest(PressureRate(medium).source(still_flow.view).end) == 0);
      // A vertex that moves sees the pressure of other places change, which beta·grad p takes away again.
      const FakeFlow moving(*scene, pressure, at_rest, inner_motion, 1e-3);
      double seen = 0;
      for (std::size_t v = 0; v < moving.view.pressure_end.size(); ++v) {
        seen = std::max(seen, std::abs(moving.view.pressure_end[v] - moving.view.pressure_begin[v]) / 1e-3);
      }
      const double source = largest(PressureRate(medium).source(moving.view).end);
      CHECK(source <= 1e-9 * 300 / (density * speed * speed));
      if (pressure({0.5, 0, 0}, 0) != 1000) CHECK(base::largest(MPI_COMM_WORLD, seen) > 10);
    }
  }
}

TEST_CASE("the flow's outlet gives its volume flow to the air, at the beginning and the end each its own") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const auto velocity = [](const Point& x, double t) { return Point{(2 + x[1]) * (1 + 1000 * t), 5, 7}; };
    const FakeFlow flow(
        *scene, [](const Point&, double) { return 0.0; }, velocity, still, 1e-3);
    const AnalogySource source = PressureRate(medium).source(flow.view);
    // ∫ (2 + y) dy over the height ½, times the depth.
    const double expected = (1 + 0.125) * (d == 2 ? 1 : 0.5);
    CHECK(total(source.begin) == Approx(expected).epsilon(1e-12));
    CHECK(total(source.end) == Approx(2 * expected).epsilon(1e-12));
  }
}

TEST_CASE("the pressure's jump in a change of phase makes no sound, nor do cells in contact") {
  for (const int d : {2, 3}) {
    const auto scene = channel(d);
    const mesh::Mesh& mesh = scene->flow->mesh;
    const double rate = 250, dt = 1e-3;
    const auto velocity = [](const Point&, double) { return Point{1, 0, 0}; };
    const auto rises = [&](const Point& x, double t) { return 40 - 300 * x[0] + rate * t; };
    std::vector<std::int32_t> in_contact;
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      double x = 0;
      for (const std::int32_t v : mesh.vertices_of(cell)) x += mesh.point(v)[0] / (d + 1);
      in_contact.push_back(x > 0.7);  // up to the outlet
    }
    const std::vector<std::int32_t> silent = mesh::mark_vertices_of_cells(mesh, in_contact);
    const auto source_with = [&](double jump, const std::function<Point(const Point&)>& motion) {
      FakeFlow flow(*scene, rises, velocity, motion, dt);
      for (std::size_t v = 0; v < silent.size(); ++v) flow.view.pressure_end[v] += silent[v] ? jump : 0;
      for (std::size_t cell = 0; cell < in_contact.size(); ++cell) {
        if (in_contact[cell]) flow.view.cell_is_fluid[cell] = 0;
      }
      flow.view.vertex_is_silent = silent;
      AnalogySource source = PressureRate(medium).source(flow.view);
      return source.end.values;
    };
    for (const auto& motion : {std::function<Point(const Point&)>(still), {inner_motion}}) {
      const std::vector<double> quiet = source_with(0, motion), jumps = source_with(1e9, motion);
      CHECK(quiet == jumps);
      double left = 0, all = 0;
      for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
        all += quiet[v];
        if (mesh.point(v)[0] < 0.4) left = std::max(left, std::abs(quiet[v]));
        if (mesh.point(v)[0] > 0.75) CHECK(quiet[v] == 0);
      }
      CHECK(base::largest(MPI_COMM_WORLD, left) > 0);
      all = base::sum(MPI_COMM_WORLD, all);
      CHECK(all < 0);
      CHECK(all > -volume(d) * rate / (density * speed * speed));
    }
  }
}

TEST_CASE("the analogy of silence is silent") {
  const auto scene = channel(2);
  const auto velocity = [](const Point&, double) { return Point{3, 0, 0}; };
  const FakeFlow flow(
      *scene, [](const Point&, double t) { return t; }, velocity, still, 1e-3);
  const AnalogySource source = make_analogy({.name = "none"}, medium)->source(flow.view);
  CHECK(largest(source.begin) == 0);
  CHECK(largest(source.end) == 0);
}
