#include "core/fem/simplex.hpp"

#include <cmath>

#include "core/mesh/mesh.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// Mean over a simplex of the product of powers of the barycentric coordinates: d! Π a_i! / (d + Σ a_i)!
double mean_of_monomial(int dimension, const std::array<int, 4>& power) {
  double product = factorial(dimension);
  int sum = dimension;
  for (int i = 0; i <= dimension; ++i) {
    product *= factorial(power[i]);
    sum += power[i];
  }
  return product / factorial(sum);
}

/// The nodes of P1 or P2: corners, then the middles of edges.
std::vector<std::array<double, 4>> nodes(int dimension, int degree) {
  std::vector<std::array<double, 4>> result;
  for (int i = 0; i <= dimension; ++i) {
    result.push_back({0, 0, 0, 0});
    result.back()[i] = 1;
  }
  if (degree == 1) return result;
  for (const auto& [a, b] : mesh::edges_of_cell(dimension)) {
    result.push_back({0, 0, 0, 0});
    result.back()[a] = result.back()[b] = 0.5;
  }
  return result;
}

const std::array<double, 4> inside_triangle = {0.2, 0.5, 0.3, 0};
const std::array<double, 4> inside_tetrahedron = {0.1, 0.4, 0.3, 0.2};

}  // namespace

TEST_CASE("each quadrature rule integrates all monomials of its degree", "[serial]") {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (int degree = 0; degree <= (dimension == 3 ? 4 : 5); ++degree) {
      const auto& rule = fem::quadrature(dimension, degree);
      CHECK(rule.dimension == dimension);
      for (int a = 0; a <= degree; ++a) {
        for (int b = 0; a + b <= degree; ++b) {
          for (int c = 0; a + b + c <= degree; ++c) {
            for (int e = 0; a + b + c + e <= degree; ++e) {
              if ((dimension < 2 && c > 0) || (dimension < 3 && e > 0)) continue;
              double sum = 0;
              for (std::size_t q = 0; q < rule.points.size(); ++q) {
                const auto& x = rule.points[q];
                sum += rule.weights[q] * std::pow(x[0], a) * std::pow(x[1], b) * std::pow(x[2], c) * std::pow(x[3], e);
              }
              INFO("dimension " << dimension << ", degree " << degree << ", powers " << a << b << c << e);
              // The triangle's rule of degree 4 is given to 15 digits.
              CHECK(sum == Approx(mean_of_monomial(dimension, {a, b, c, e})).epsilon(1e-13));
            }
          }
        }
      }
    }
  }
}

TEST_CASE("quadrature points lie inside; weights up to degree 2 are positive", "[serial]") {
  for (int dimension = 1; dimension <= 3; ++dimension) {
    for (int degree = 0; degree <= (dimension == 3 ? 4 : 5); ++degree) {
      const auto& rule = fem::quadrature(dimension, degree);
      for (std::size_t q = 0; q < rule.points.size(); ++q) {
        double sum = 0;
        for (int i = 0; i <= dimension; ++i) {
          CHECK(rule.points[q][i] > 0);
          sum += rule.points[q][i];
        }
        CHECK(sum == Approx(1).epsilon(1e-14));
        if (degree <= 2) CHECK(rule.weights[q] > 0);
      }
    }
  }
}

TEST_CASE("a basis function is one at its node and zero at the others", "[serial]") {
  for (const int dimension : {2, 3}) {
    for (const int degree : {1, 2}) {
      const auto points = nodes(dimension, degree);
      std::vector<double> values(points.size());
      for (std::size_t i = 0; i < points.size(); ++i) {
        fem::basis_values(dimension, degree, points[i], values);
        for (std::size_t j = 0; j < points.size(); ++j) CHECK(values[j] == (i == j ? 1.0 : 0.0));
      }
    }
  }
}

TEST_CASE("basis functions sum to one and their gradients to nothing", "[serial]") {
  for (const int dimension : {2, 3}) {
    const auto& point = dimension == 2 ? inside_triangle : inside_tetrahedron;
    for (const int degree : {1, 2}) {
      const std::size_t n = nodes(dimension, degree).size();
      std::vector<double> values(n), derivatives(n * (dimension + 1));
      fem::basis_values(dimension, degree, point, values);
      fem::basis_derivatives(dimension, degree, point, derivatives);
      double sum = 0;
      for (const double value : values) sum += value;
      CHECK(sum == Approx(1));
      // In space only differences of barycentric derivatives count: those of a constant are all equal.
      std::vector<double> total(dimension + 1, 0.0);
      for (std::size_t j = 0; j < n; ++j) {
        for (int i = 0; i <= dimension; ++i) total[i] += derivatives[j * (dimension + 1) + i];
      }
      for (int i = 1; i <= dimension; ++i) CHECK(total[i] == Approx(total[0]));
    }
  }
}

TEST_CASE("derivatives of the basis agree with differences of its values", "[serial]") {
  const double step = 1e-6;
  for (const int dimension : {2, 3}) {
    const auto& point = dimension == 2 ? inside_triangle : inside_tetrahedron;
    const std::size_t n = nodes(dimension, 2).size();
    std::vector<double> derivatives(n * (dimension + 1)), before(n), after(n);
    fem::basis_derivatives(dimension, 2, point, derivatives);
    for (int i = 0; i <= dimension; ++i) {
      auto lower = point, upper = point;
      lower[i] -= step;
      upper[i] += step;
      fem::basis_values(dimension, 2, lower, before);
      fem::basis_values(dimension, 2, upper, after);
      for (std::size_t j = 0; j < n; ++j) {
        CHECK(derivatives[j * (dimension + 1) + i] == Approx((after[j] - before[j]) / (2 * step)).margin(1e-8));
      }
    }
  }
}

TEST_CASE("barycentric gradients belong to the corners", "[serial]") {
  // gradient_i · (x_j - x_0) = δ_ij for j > 0.
  const double a[3] = {0.1, 0.2, 0.3}, b[3] = {1.1, 0.4, 0.2}, c[3] = {0.3, 1.5, 0.1}, d[3] = {0.2, 0.4, 0.9};
  const auto triangle = fem::simplex_geometry<2>({a, b, c});
  CHECK(triangle.measure == Approx(0.5 * ((1.0 * 1.3) - (0.2 * 0.2))));
  const auto tetrahedron = fem::simplex_geometry<3>({a, b, c, d});
  const double* corners[4] = {a, b, c, d};
  for (int j = 1; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) {
      double plane = 0, solid = 0;
      for (int k = 0; k < 3; ++k) {
        solid += tetrahedron.gradient[i][k] * (corners[j][k] - a[k]);
        if (k < 2 && i < 3) plane += triangle.gradient[i][k] * (corners[j][k] - a[k]);
      }
      const double wanted = i == j ? 1 : (i == 0 ? -1 : 0);
      CHECK(solid == Approx(wanted).margin(1e-14));
      if (i < 3 && j < 3) CHECK(plane == Approx(wanted).margin(1e-14));
    }
  }
  const double flat[2] = {1, 0}, origin[2] = {0, 0}, up[2] = {0, 1};
  CHECK(fem::simplex_geometry<2>({origin, up, flat}).measure == Approx(-0.5));
}
