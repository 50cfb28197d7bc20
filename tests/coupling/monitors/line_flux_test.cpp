#include "coupling/monitors/line_flux.hpp"

#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

struct Plane {
  mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {2, 1, 0}, {8, 5, 0}));
  fem::Space space;
  std::vector<double> points;
  std::vector<std::int32_t> everywhere;

  explicit Plane(int degree) : space(fem::lagrange(mesh, degree)), points(fem::dof_points(space)) {
    everywhere.assign(mesh.cell_region.size(), 1);
  }
  /// A function of where the dofs are.
  fem::Field field(const std::function<fem::Point(double, double)>& function) const {
    fem::Field result(space, 2);
    for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
      const fem::Point value = function(points[2 * dof], points[2 * dof + 1]);
      result.at(dof)[0] = value[0], result.at(dof)[1] = value[1];
    }
    return result;
  }
};

fem::Point parabola(double x, double y) { return {4 * y * (1 - y) + x, 3 - x * y, 0}; }

}  // namespace

TEST_CASE("the flux across an oblique line is exact for a velocity of the space's degree") {
  const Plane linear(1), quadratic(2);
  const fem::Point from = {0.3, 0.1, 0}, to = {1.71, 0.83, 0};
  // v = (1 + y, -2 x): ∫ v·n with n ds = (dy, -dx)
  const double wanted = 0.73 * (1 + 0.465) + 1.41 * 2 * 1.005;
  for (const Plane* plane : {&linear, &quadratic}) {
    const fem::Field velocity = plane->field([](double x, double y) { return fem::Point{1 + y, -2 * x, 0}; });
    CHECK(flux_across(velocity, plane->points, from, to, plane->everywhere) == Approx(wanted).epsilon(1e-10));
    CHECK(flux_across(velocity, plane->points, to, from, plane->everywhere) == Approx(-wanted).epsilon(1e-10));
  }
  const auto integrand = [&](double s) {
    const fem::Point v = parabola(from[0] + s * 1.41, from[1] + s * 0.73);
    return v[0] * 0.73 - v[1] * 1.41;
  };
  const double exact = (integrand(0) + 4 * integrand(0.5) + integrand(1)) / 6;  // Simpson, of degree 2
  CHECK(flux_across(quadratic.field(parabola), quadratic.points, from, to, quadratic.everywhere) ==
        Approx(exact).epsilon(1e-10));
}

TEST_CASE("a line along facets counts once, on the boundary, too, and what is outside does not count") {
  const Plane plane(2);
  const fem::Field velocity = plane.field(parabola);
  for (const double x : {0.0, 0.25, 0.5, 1.0, 2.0, 0.6}) {
    const double wanted = 2.0 / 3 + x;
    CHECK(flux_across(velocity, plane.points, {x, -1, 0}, {x, 3, 0}, plane.everywhere) == Approx(wanted).epsilon(1e-7));
  }
  CHECK(flux_across(velocity, plane.points, {2.1, 0, 0}, {2.1, 1, 0}, plane.everywhere) == 0);
}

TEST_CASE("only marked cells take part") {
  const Plane plane(1);
  std::vector<std::int32_t> lower;  // the cells in y < 0.4
  for (std::int32_t cell = 0; cell < plane.mesh.num_cells(); ++cell) {
    double y = 0;
    for (const std::int32_t v : plane.mesh.vertices_of(cell)) y += plane.mesh.point(v)[1] / 3;
    lower.push_back(y < 0.4);
  }
  lower.resize(plane.everywhere.size());
  plane.mesh.cell_halo.copy_to_ghosts(std::span<std::int32_t>(lower));
  const fem::Field velocity = plane.field([](double, double) { return fem::Point{3, 2, 0}; });
  for (const double x : {0.6, 0.5}) {
    CHECK(flux_across(velocity, plane.points, {x, 0, 0}, {x, 1, 0}, lower) == Approx(1.2).epsilon(1e-7));
  }
  // Along their rim, and in the midst of them
  CHECK(flux_across(velocity, plane.points, {0, 0.4, 0}, {2, 0.4, 0}, lower) == Approx(-4));
  CHECK(flux_across(velocity, plane.points, {0, 0.2, 0}, {2, 0.2, 0}, lower) == Approx(-4));
}

TEST_CASE("in a bent mesh a velocity that is linear where things are now is exact") {
  Plane plane(2);
  for (std::int32_t dof = 0; dof < plane.space.num_dofs(); ++dof) {
    double* x = plane.points.data() + 2 * dof;
    x[1] += 0.1 * x[0] * x[0];
  }
  const fem::Field velocity = plane.field([](double x, double y) { return fem::Point{1 + y, -2 * x, 0}; });
  const double wanted = 0.5 * (1 + 0.55) + 1.2 * 2 * 1.0;
  CHECK(flux_across(velocity, plane.points, {0.4, 0.3, 0}, {1.6, 0.8, 0}, plane.everywhere) ==
        Approx(wanted).epsilon(1e-9));
}
