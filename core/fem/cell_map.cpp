#include "core/fem/cell_map.hpp"

#include <algorithm>
#include <cmath>

#include "core/fem/simplex.hpp"

namespace vocalis::fem {

namespace {

using Matrix = std::array<Point, 3>;

double determinant(const Matrix& m, int d) {
  if (d == 2) return m[0][0] * m[1][1] - m[0][1] * m[1][0];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// x with Σ_j rows[j] x_j = right, by Cramer's rule.
Point solve(const Matrix& rows, const Point& right, int d) {
  const double whole = determinant(rows, d);
  Point result = {0, 0, 0};
  for (int j = 0; j < d; ++j) {
    Matrix replaced = rows;
    replaced[j] = right;
    result[j] = determinant(replaced, d) / whole;
  }
  return result;
}

}  // namespace

CellMap::CellMap(const Space& space, std::span<const double> points, std::int32_t cell)
    : dimension_(space.mesh->dimension), degree_(space.degree), nodes_(space.dofs_per_cell), points_{} {
  const auto dofs = space.dofs_of(cell);
  for (int i = 0; i < nodes_; ++i) {
    std::copy_n(points.begin() + static_cast<std::ptrdiff_t>(dofs[i]) * dimension_, dimension_, points_[i].begin());
  }
}

Point CellMap::at(const Barycentric& coordinates) const {
  std::array<double, 10> basis;
  fem::basis_values(dimension_, degree_, coordinates, {basis.data(), static_cast<std::size_t>(nodes_)});
  Point result = {0, 0, 0};
  for (int i = 0; i < nodes_; ++i) {
    for (int k = 0; k < dimension_; ++k) result[k] += basis[i] * points_[i][k];
  }
  return result;
}

std::array<Point, 4> CellMap::derivatives(const Barycentric& coordinates) const {
  const int corners = dimension_ + 1;
  std::array<double, 40> basis;
  fem::basis_derivatives(dimension_, degree_, coordinates, {basis.data(), static_cast<std::size_t>(nodes_ * corners)});
  std::array<Point, 4> result{};
  for (int i = 0; i < nodes_; ++i) {
    for (int a = 0; a < corners; ++a) {
      for (int k = 0; k < dimension_; ++k) result[a][k] += basis[i * corners + a] * points_[i][k];
    }
  }
  return result;
}

std::optional<Barycentric> CellMap::coordinates_of(const Point& point) const {
  constexpr int largest_iterations = 20;
  constexpr double tolerance = 1e-9;  // of the last change: Newton leaves its square
  Barycentric result = {1, 0, 0, 0};
  for (int iteration = 0; iteration < largest_iterations; ++iteration) {
    const Point here = at(result);
    // The first step starts in a corner with the straight cell's derivatives: it finds the straight cell's coordinates.
    const std::array<Point, 4> slope = derivatives(result);
    Matrix rows{};
    Point distance = {0, 0, 0};
    for (int k = 0; k < dimension_; ++k) {
      distance[k] = point[k] - here[k];
      for (int j = 0; j < dimension_; ++j) {
        rows[j][k] = iteration == 0 ? points_[j + 1][k] - points_[0][k] : slope[j + 1][k] - slope[0][k];
      }
    }
    const Point change = solve(rows, distance, dimension_);
    double size = 0;
    for (int j = 0; j < dimension_; ++j) {
      result[j + 1] += change[j];
      result[0] -= change[j];
      size = std::max(size, std::abs(change[j]));
    }
    if (!(size < 10)) return {};
    if (size < tolerance || (degree_ == 1 && iteration == 0)) return result;
  }
  return {};
}

double value_in(const Field& field, std::int32_t cell, const Barycentric& coordinates, int component) {
  const Space& space = *field.space;
  std::array<double, 10> basis;
  fem::basis_values(space.mesh->dimension, space.degree, coordinates,
                    {basis.data(), static_cast<std::size_t>(space.dofs_per_cell)});
  const auto dofs = space.dofs_of(cell);
  double result = 0;
  for (int i = 0; i < space.dofs_per_cell; ++i) result += basis[i] * field.at(dofs[i])[component];
  return result;
}

}  // namespace vocalis::fem
