#pragma once

#include <array>
#include <vector>

#include "core/fem/simplex.hpp"
#include "core/fem/space.hpp"
#include "fsi_solver/cells/constitutive.hpp"

namespace vocalis::fsi {

/// A cell with velocity and geometry of degree 1 or 2 (isoparametric) and pressure of degree 1.
///
/// A cell's unknowns: velocity (node by node, vertices before edges), then pressure at the corners, and with degree 1
/// the projected pressure gradient there.
template <int D, int Degree>
struct Element {
  static constexpr int corners = D + 1;
  static constexpr int nodes = Degree == 1 ? corners : corners * (D + 2) / 2;
  static constexpr bool is_stabilised = Degree == 1;  ///< its pressure is; a projected gradient is an unknown
  static constexpr int count = nodes * D + corners * (is_stabilised ? 1 + D : 1);
  static constexpr int velocity(int node, int component) { return node * D + component; }
  static constexpr int pressure(int corner) { return nodes * D + corner; }
  static constexpr int gradient(int corner, int component) { return nodes * D + corners + corner * D + component; }

  /// The basis at a point of a quadrature rule.
  struct Point {
    double weight;                ///< of the reference cell, whose measure 1 / D! is in it
    double value[nodes];          ///< of the velocity's basis
    double derivative[nodes][D];  ///< with respect to the barycentric coordinates 1 .. D
    double corner[corners];       ///< of the pressure's basis: the barycentric coordinates
  };
  /// Exact for mass and convection of a straight cell where a rule is at hand (tetrahedra of degree 2: mass).
  static const std::vector<Point>& points();
  /// On the facet opposite to a corner; the weights sum to 1.
  static const std::vector<Point>& facet_points(int facet);
};

/// The map from the reference cell at one point.
template <int D, int Degree>
struct PointGeometry {
  Lanes gradient[Element<D, Degree>::nodes][D];  ///< of the velocity's basis [1/m]
  Lanes corner_gradient[D + 1][D];               ///< of the pressure's basis [1/m]
  Lanes determinant;                             ///< [m^D]
};

template <int D, int Degree>
PointGeometry<D, Degree> geometry_at(const typename Element<D, Degree>::Point& point,
                                     const Lanes (&position)[Element<D, Degree>::nodes][D]) {
  constexpr int nodes = Element<D, Degree>::nodes;
  Matrix<D, Lanes> jacobian{};
  for (int a = 0; a < nodes; ++a) {
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) jacobian[i][j] += position[a][i] * point.derivative[a][j];
    }
  }
  PointGeometry<D, Degree> result;
  Matrix<D, Lanes> inverse = cofactor<D>(jacobian);  // transposed
  result.determinant = determinant<D>(jacobian);
  const Lanes factor = 1.0 / result.determinant;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) inverse[i][j] *= factor;
  }
  for (int a = 0; a < nodes; ++a) {
    for (int i = 0; i < D; ++i) {
      Lanes sum = inverse[i][0] * point.derivative[a][0];
      for (int j = 1; j < D; ++j) sum += inverse[i][j] * point.derivative[a][j];
      result.gradient[a][i] = sum;
    }
  }
  for (int i = 0; i < D; ++i) {
    Lanes sum{};
    for (int j = 0; j < D; ++j) {
      result.corner_gradient[j + 1][i] = inverse[i][j];
      sum += inverse[i][j];
    }
    result.corner_gradient[0][i] = -sum;
  }
  return result;
}

/// Σ_a x_a ⊗ ∇φ_a
template <int D, int Nodes>
Matrix<D, Lanes> gradient_of(const Lanes (&x)[Nodes][D], const Lanes (&gradient)[Nodes][D]) {
  Matrix<D, Lanes> result{};
  for (int a = 0; a < Nodes; ++a) {
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) result[i][j] += x[a][i] * gradient[a][j];
    }
  }
  return result;
}

/// Σ_a x_a φ_a
template <int D, int Nodes>
std::array<Lanes, D> value_of(const Lanes (&x)[Nodes][D], const double (&value)[Nodes]) {
  std::array<Lanes, D> result{};
  for (int a = 0; a < Nodes; ++a) {
    for (int i = 0; i < D; ++i) result[i] += x[a][i] * value[a];
  }
  return result;
}

/// Calls a function template with the dimension and degree of a velocity's space.
template <class Function>
void with_element(const fem::Space& velocities, const Function& function) {
  const bool is_linear = velocities.degree == 1;
  if (velocities.mesh->dimension == 2) {
    is_linear ? function.template operator()<2, 1>() : function.template operator()<2, 2>();
  } else {
    is_linear ? function.template operator()<3, 1>() : function.template operator()<3, 2>();
  }
}

}  // namespace vocalis::fsi
