#include "core/fem/simplex.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "core/mesh/mesh.hpp"

namespace vocalis::fem {

namespace {

/// All distinct permutations of a point's barycentric coordinates, each with the same weight.
void add_orbit(QuadratureRule& rule, std::array<double, 4> point, double weight) {
  const auto end = point.begin() + rule.dimension + 1;
  std::sort(point.begin(), end);
  do {
    rule.points.push_back(point);
    rule.weights.push_back(weight);
  } while (std::next_permutation(point.begin(), end));
}

QuadratureRule interval_rule(int degree) {
  QuadratureRule rule{1, {}, {}};
  if (degree <= 1) {
    add_orbit(rule, {0.5, 0.5, 0, 0}, 1);
  } else if (degree <= 3) {
    const double a = 0.5 - 0.5 / std::sqrt(3.0);
    add_orbit(rule, {a, 1 - a, 0, 0}, 0.5);
  } else {
    const double a = 0.5 - 0.5 * std::sqrt(0.6);
    add_orbit(rule, {0.5, 0.5, 0, 0}, 8.0 / 18);
    add_orbit(rule, {a, 1 - a, 0, 0}, 5.0 / 18);
  }
  return rule;
}

QuadratureRule triangle_rule(int degree) {
  QuadratureRule rule{2, {}, {}};
  const double third = 1.0 / 3;
  if (degree <= 1) {
    add_orbit(rule, {third, third, third, 0}, 1);
  } else if (degree == 2) {
    add_orbit(rule, {1.0 / 6, 1.0 / 6, 2.0 / 3, 0}, third);
  } else if (degree <= 4) {
    const double a = 0.445948490915965, b = 0.091576213509771;
    add_orbit(rule, {a, a, 1 - 2 * a, 0}, 0.223381589678011);
    add_orbit(rule, {b, b, 1 - 2 * b, 0}, 0.109951743655322);
  } else {
    const double root = std::sqrt(15.0), a = (6 - root) / 21, b = (6 + root) / 21;
    add_orbit(rule, {third, third, third, 0}, 9.0 / 40);
    add_orbit(rule, {a, a, 1 - 2 * a, 0}, (155 - root) / 1200);
    add_orbit(rule, {b, b, 1 - 2 * b, 0}, (155 + root) / 1200);
  }
  return rule;
}

QuadratureRule tetrahedron_rule(int degree) {
  QuadratureRule rule{3, {}, {}};
  if (degree <= 1) {
    add_orbit(rule, {0.25, 0.25, 0.25, 0.25}, 1);
  } else if (degree == 2) {
    const double a = (5 - std::sqrt(5.0)) / 20;
    add_orbit(rule, {a, a, a, 1 - 3 * a}, 0.25);
  } else if (degree == 3) {
    add_orbit(rule, {0.25, 0.25, 0.25, 0.25}, -0.8);
    add_orbit(rule, {1.0 / 6, 1.0 / 6, 1.0 / 6, 0.5}, 0.45);
  } else {
    const double a = (1 + std::sqrt(5.0 / 14)) / 4;
    add_orbit(rule, {0.25, 0.25, 0.25, 0.25}, -148.0 / 1875);
    add_orbit(rule, {1.0 / 14, 1.0 / 14, 1.0 / 14, 11.0 / 14}, 343.0 / 7500);
    add_orbit(rule, {a, a, 0.5 - a, 0.5 - a}, 56.0 / 375);
  }
  return rule;
}

}  // namespace

const QuadratureRule& quadrature(int dimension, int degree) {
  assert(dimension >= 1 && dimension <= 3 && degree >= 0 && degree <= (dimension == 3 ? 4 : 5));
  static const std::array<std::array<QuadratureRule, 6>, 3> rules = [] {
    std::array<std::array<QuadratureRule, 6>, 3> all;
    for (int d = 0; d < 6; ++d)
      all[0][d] = interval_rule(d), all[1][d] = triangle_rule(d), all[2][d] = tetrahedron_rule(d);
    return all;
  }();
  return rules[dimension - 1][degree];
}

void basis_values(int dimension, int degree, const std::array<double, 4>& point, std::span<double> values) {
  const int corners = dimension + 1;
  if (degree == 1) {
    std::copy_n(point.begin(), corners, values.begin());
    return;
  }
  for (int i = 0; i < corners; ++i) values[i] = point[i] * (2 * point[i] - 1);
  int dof = corners;
  for (const auto& [a, b] : mesh::edges_of_cell(dimension)) values[dof++] = 4 * point[a] * point[b];
}

void basis_derivatives(int dimension, int degree, const std::array<double, 4>& point, std::span<double> derivatives) {
  const int corners = dimension + 1;
  std::fill(derivatives.begin(), derivatives.end(), 0.0);
  for (int i = 0; i < corners; ++i) derivatives[i * corners + i] = degree == 1 ? 1 : 4 * point[i] - 1;
  if (degree == 1) return;
  int dof = corners;
  for (const auto& [a, b] : mesh::edges_of_cell(dimension)) {
    derivatives[dof * corners + a] = 4 * point[b];
    derivatives[dof * corners + b] = 4 * point[a];
    ++dof;
  }
}

}  // namespace vocalis::fem
