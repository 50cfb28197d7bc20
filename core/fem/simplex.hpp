#pragma once

#include <array>
#include <span>
#include <vector>

namespace vocalis::fem {

/// Points (barycentric coordinates) and weights that sum to 1: multiply by the simplex' measure.
struct QuadratureRule {
  int dimension = 2;
  std::vector<std::array<double, 4>> points;
  std::vector<double> weights;
};

/// A rule exact for polynomials of `degree` (1 to 5 on intervals and triangles, 1 to 4 on tetrahedra); all weights are
/// positive up to degree 2.
/// Sources: Gauss (interval); Dunavant 1985, Int. J. Numer. Meth. Eng. 21 (triangle); Keast 1986, Comput. Meth. Appl.
/// Mech. Eng. 55 (tetrahedron).
const QuadratureRule& quadrature(int dimension, int degree);

/// Values of the Lagrange basis at a point: P1 the barycentric coordinates, P2 vertices λ(2λ - 1), then edges 4 λa λb.
///
/// values  (dofs)
void basis_values(int dimension, int degree, const std::array<double, 4>& point, std::span<double> values);

/// Derivatives of the basis with respect to the barycentric coordinates, (dofs, dimension + 1): a gradient in space is
/// their product with the gradients of the barycentric coordinates.
void basis_derivatives(int dimension, int degree, const std::array<double, 4>& point, std::span<double> derivatives);

/// Gradients of the barycentric coordinates [1/m] and measure [m^2, m^3] of a simplex.
template <int Dimension>
struct SimplexGeometry {
  std::array<std::array<double, Dimension>, Dimension + 1> gradient;
  double measure;
};

/// corners  one pointer to `Dimension` coordinates a vertex
template <int Dimension>
SimplexGeometry<Dimension> simplex_geometry(const std::array<const double*, Dimension + 1>& corners) {
  SimplexGeometry<Dimension> result;
  double e[3][3] = {};
  for (int i = 0; i < Dimension; ++i) {
    for (int k = 0; k < Dimension; ++k) e[i][k] = corners[i + 1][k] - corners[0][k];
  }
  if constexpr (Dimension == 2) {
    const double determinant = e[0][0] * e[1][1] - e[0][1] * e[1][0];
    result.measure = 0.5 * determinant;
    result.gradient[1] = {e[1][1] / determinant, -e[1][0] / determinant};
    result.gradient[2] = {-e[0][1] / determinant, e[0][0] / determinant};
  } else {
    const auto cross = [&e](int a, int b) {
      return std::array<double, 3>{e[a][1] * e[b][2] - e[a][2] * e[b][1], e[a][2] * e[b][0] - e[a][0] * e[b][2],
                                   e[a][0] * e[b][1] - e[a][1] * e[b][0]};
    };
    const std::array<std::array<double, 3>, 3> faces = {cross(1, 2), cross(2, 0), cross(0, 1)};
    const double determinant = e[0][0] * faces[0][0] + e[0][1] * faces[0][1] + e[0][2] * faces[0][2];
    result.measure = determinant / 6;
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) result.gradient[i + 1][k] = faces[i][k] / determinant;
    }
  }
  for (int k = 0; k < Dimension; ++k) {
    result.gradient[0][k] = 0;
    for (int i = 1; i <= Dimension; ++i) result.gradient[0][k] -= result.gradient[i][k];
  }
  return result;
}

}  // namespace vocalis::fem
