#include "core/fem/norms.hpp"

#include <cmath>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

mesh::Mesh box(int dimension) {
  return mesh::distribute(MPI_COMM_WORLD,
                          mesh::box(MPI_COMM_WORLD, {2, 1, dimension == 3 ? 1.5 : 0}, {3, 4, dimension == 3 ? 2 : 0}));
}

}  // namespace

TEST_CASE("norms of polynomials of the element's degree are exact") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh domain = box(dimension);
    const double depth = dimension == 3 ? 1.5 : 1;
    for (const int degree : {1, 2}) {
      const fem::Space space = fem::lagrange(domain, degree);
      // u = (x^degree, y): on [0, 2] x [0, 1], ∫ x² = 8/3, ∫ x⁴ = 32/5, ∫ y² = 2/3, each times the depth.
      const auto exact = [degree](std::span<const double> x, std::span<double> u) {
        u[0] = std::pow(x[0], degree);
        u[1] = x[1];
      };
      const auto gradient = [degree](std::span<const double> x, std::span<double> g) {
        g[0] = degree == 1 ? 1 : 2 * x[0];
        g[x.size() + 1] = 1;
      };
      const fem::Field field = fem::interpolate(space, 2, exact);
      const double square = degree == 1 ? 8.0 / 3 : 32.0 / 5;
      CHECK(fem::l2_norm(field) == Approx(std::sqrt(depth * (square + 2.0 / 3))).epsilon(1e-12));
      CHECK(fem::l2_error(field, exact) < 1e-13);
      const double slope = degree == 1 ? 2 : 4 * 8.0 / 3;
      CHECK(fem::h1_seminorm(field) == Approx(std::sqrt(depth * (slope + 2))).epsilon(1e-12));
      CHECK(fem::h1_seminorm_error(field, gradient) < 1e-12);
      const auto totals = fem::integral(field);
      CHECK(totals[0] == Approx(depth * (degree == 1 ? 2 : 8.0 / 3)).epsilon(1e-12));
      CHECK(totals[1] == Approx(depth).epsilon(1e-12));
    }
  }
}

TEST_CASE("a norm of the difference is that of the function left over") {
  const mesh::Mesh domain = box(2);
  const fem::Space space = fem::lagrange(domain, 1);
  const fem::Field zero(space, 1);
  const auto one = [](std::span<const double>, std::span<double> u) { u[0] = 1; };
  CHECK(fem::l2_error(zero, one) == Approx(std::sqrt(2.0)));
}

TEST_CASE("norms see only the cells where the space exists") {
  const mesh::Mesh domain = box(2);
  std::vector<std::int32_t> labels(domain.num_cells(), -1);
  for (std::int32_t cell = 0; cell < domain.num_cells(); ++cell) {
    double middle = 0;
    for (const std::int32_t vertex : domain.vertices_of(cell)) middle += domain.point(vertex)[1] / 3;
    if (middle < 0.5) labels[cell] = 0;
  }
  const fem::Space space = fem::lagrange(domain, 1, labels);
  const fem::Field one = fem::interpolate(space, 1, [](auto, std::span<double> u) { u[0] = 1; });
  CHECK(fem::integral(one)[0] == Approx(1.0));
}
