#include <catch2/catch.hpp>
#include <cmath>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/orthogonal_subscales.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {

using namespace test;

namespace {

AcousticSettings equal_order(double subscale_constant) {
  AcousticSettings settings = unit_medium(0.05);
  settings.velocity_elements = VelocityElements::p1;
  settings.subscale_constant = subscale_constant;
  return settings;
}

/// Pressure at every vertex of the input mesh, with walls, an open end, a moving inside and p = 0 at the top.
std::vector<double> run_everything(MPI_Comm comm, int dimension) {
  const mesh::Mesh mesh = unit_box(comm, dimension, 8);
  AcousticSettings settings = equal_order(0.02);
  settings.wall_admittance = 0.1;
  settings.boundaries = {{"right", AcousticBoundaryKind::open, 0, 1.5},
                         {"top", AcousticBoundaryKind::pressure_release}};
  AcousticSolver solver(mesh, settings);
  solver.set_state(bump(mesh));
  const std::vector<double> moved = deformed(mesh, 0.02);
  bool converged = solver.advance(0.1, Motion{mesh.coordinates, moved}).converged;
  converged = converged && solver.advance(0.1, Motion{moved, mesh.coordinates}).converged;
  REQUIRE_ON_ALL_RANKS(converged);
  return by_input_number(mesh, solver.state().p);
}

}  // namespace

TEST_CASE("subscales do not see what is linear, and the form of anything else with itself is positive") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, dimension, 8);
    const fem::Space space = fem::lagrange(mesh, 1);
    std::vector<double> gradients, measures;
    const auto add_cells = [&]<int D>() {
      for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
        std::array<const double*, D + 1> corners;
        for (int i = 0; i <= D; ++i) corners[i] = mesh.point(mesh.vertices_of(cell)[i]);
        const auto geometry = fem::simplex_geometry<D>(corners);
        measures.push_back(geometry.measure);
        for (const auto& gradient : geometry.gradient)
          gradients.insert(gradients.end(), gradient.begin(), gradient.end());
      }
    };
    dimension == 2 ? add_cells.operator()<2>() : add_cells.operator()<3>();
    const OrthogonalSubscales subscales(mesh, space);
    const auto form = [&](const auto& function) {
      std::vector<double> values, sums(mesh.num_vertices(), 0.0);
      for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) values.push_back(function(mesh.point(v)));
      subscales.add(gradients, measures, values, sums);
      double product = 0;
      for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) product += values[v] * sums[v];
      return base::sum(mesh.comm, product);
    };
    CHECK(std::abs(form([](const double* x) { return 3 * x[0] - x[1]; })) < 1e-12);
    CHECK(form([](const double* x) { return x[0] * x[0]; }) > 1e-5);
    CHECK(form([](const double* x) { return std::cos(8 * M_PI * x[0]); }) > 1);
  }
}

TEST_CASE("equal order does not depend on the number of ranks") {
  for (const int dimension : {2, 3}) {
    const auto alone = run_everything(MPI_COMM_SELF, dimension);
    const auto together = run_everything(MPI_COMM_WORLD, dimension);
    CHECK(largest(alone) > 0.1);
    CHECK(largest_difference(alone, together) < 1e-10 * largest(alone));
  }
}

TEST_CASE("equal order keeps the energy of a closed cavity without subscales, and loses some with them") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 16);
  for (const double constant : {0.0, 0.02}) {
    AcousticSolver solver(mesh, equal_order(constant));
    solver.set_state(bump(mesh));
    const double before = solver.energy();
    CHECK(solver.advance(10).converged);
    const double change = solver.energy() / before - 1;
    if (constant == 0) CHECK(std::abs(change) < 1e-9);
    if (constant > 0) CHECK((change < -1e-3 && change > -0.2));
  }
}

TEST_CASE("equal order is told where it does not work") {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 4);
  CHECK_THROWS_AS(AcousticSolver(mesh, equal_order(-1)), base::UserError);
  AcousticSettings by_explicit = equal_order(0.02);
  by_explicit.integrator = Integrator::leap_frog;
  CHECK_THROWS_WITH(AcousticSolver(mesh, by_explicit), Catch::Contains("P1") && Catch::Contains("implicit"));
  AcousticSettings with_layer = equal_order(0.02);
  with_layer.layers.emplace_back();  // perfectly matched
  CHECK_THROWS_WITH(AcousticSolver(mesh, with_layer), Catch::Contains("P1") && Catch::Contains("sponge"));
}

}  // namespace vocalis::acoustic
