#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "fsi_solver/cells/constitutive.hpp"

namespace vocalis::fsi {

/// The elastic energy of a cell of a moving mesh, per volume of the reference and per shear modulus:
///
///   W(F) = d/4 (Q² - 1) + κ/2 (J + 1/J - 2),   Q = |F|² / (d J^(2/d)),   J = det F,   κ = bulk_modulus
///
/// F maps the reference cell to the moved one. d/2 (Q - 1) is the isochoric neo-Hookean energy, and its stress weighted
/// by Q is that of d/4 (Q² - 1): Q is the quality weight of Degirmenci 2018, eq. (2.6, 2.7). W is 0 for rigid motions
/// only, infinite when J -> 0, and convex in (|F|, J): polyconvex, so that it has minima (Ball 1977, Arch. Rational
/// Mech. Anal. 63, 337). At F = I it is linear elasticity with Lamé's constants µ = 1 and λ = κ - 2/d.
template <int D>
class DistortionEnergy {
 public:
  static constexpr int n = (D + 1) * D;
  using Vertices = std::array<std::array<double, D>, D + 1>;  ///< a vector at each vertex of the cell

  /// gradients     of the barycentric coordinates in the reference cell
  /// displacement  of the cell's vertices
  DistortionEnergy(double bulk_modulus, const Vertices& gradients, const Vertices& displacement)
      : bulk_modulus_(bulk_modulus), gradients_(gradients) {
    for (int i = 0; i < D; ++i) {
      f_[i][i] = 1;
      for (int a = 0; a <= D; ++a) {
        for (int k = 0; k < D; ++k) f_[i][k] += displacement[a][i] * gradients[a][k];
      }
    }
    j_ = determinant<D>(f_);
    norm_ = contraction<D>(f_, f_);
  }

  const Matrix<D>& f() const { return f_; }
  double j() const { return j_; }

  /// W, infinite for an inverted cell.
  double value() const {
    if (!(j_ > 0)) return std::numeric_limits<double>::infinity();
    return 0.25 * D * (squared_distortion() - 1) + 0.5 * bulk_modulus_ * (j_ + 1 / j_ - 2);
  }

  /// Derivatives of W by the displacements. J must be positive.
  std::array<double, n> gradient() const {
    const auto [of_norm, of_j] = derivatives();
    const auto [w_norm, w_j] = slopes();
    std::array<double, n> result;
    for (int r = 0; r < n; ++r) result[r] = w_norm * of_norm[r] + w_j * of_j[r];
    return result;
  }

  /// Writes `weight` times the second derivatives, (n, n). Without the `curvature` of J, W_,J d²J is left out, as if F
  /// and J were independent: positive semi-definite for any F, since W is polyconvex. J must be positive.
  void hessian(double weight, bool curvature, double* result) const {
    const auto [of_norm, of_j] = derivatives();
    const auto [w_norm, w_j] = slopes();
    const double square = squared_distortion();
    const double w_norm_norm = w_norm / norm_;
    const double w_norm_j = -2 * square / (norm_ * j_);
    const double w_j_j = (4.0 / D + 1) * square / (j_ * j_) + bulk_modulus_ / (j_ * j_ * j_);
    const double bend = curvature ? w_j / j_ : 0.0;
    for (int r = 0; r < n; ++r) {
      const int a = r / D, i = r % D;
      for (int s = 0; s < n; ++s) {
        const int b = s / D, k = s % D;
        double value = w_norm_norm * of_norm[r] * of_norm[s] + w_j_j * of_j[r] * of_j[s] +
                       w_norm_j * (of_norm[r] * of_j[s] + of_j[r] * of_norm[s]) +
                       bend * (of_j[r] * of_j[s] - of_j[b * D + i] * of_j[a * D + k]);
        for (int m = 0; i == k && m < D; ++m) value += 2 * w_norm * gradients_[a][m] * gradients_[b][m];
        result[r * n + s] = weight * value;
      }
    }
  }

 private:
  /// Q²
  double squared_distortion() const {
    const double power = D == 2 ? j_ * j_ : std::pow(j_, 4.0 / D);
    return norm_ * norm_ / (D * D * power);
  }
  /// Derivatives of |F|² and J by the displacements.
  std::array<std::array<double, n>, 2> derivatives() const {
    const Matrix<D> cof = cofactor<D>(f_);
    std::array<std::array<double, n>, 2> result{};
    for (int r = 0; r < n; ++r) {
      for (int k = 0; k < D; ++k) {
        result[0][r] += 2 * f_[r % D][k] * gradients_[r / D][k];
        result[1][r] += cof[r % D][k] * gradients_[r / D][k];
      }
    }
    return result;
  }
  /// Derivatives of W by |F|² and J.
  std::array<double, 2> slopes() const {
    const double square = squared_distortion();
    return {0.5 * D * square / norm_, 0.5 * bulk_modulus_ * (1 - 1 / (j_ * j_)) - square / j_};
  }

  double bulk_modulus_;
  Vertices gradients_;
  Matrix<D> f_{};
  double j_, norm_;  ///< J and |F|²
};

}  // namespace vocalis::fsi
