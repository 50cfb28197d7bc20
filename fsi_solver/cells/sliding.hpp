#pragma once

#include "fsi_solver/cells/constitutive.hpp"

namespace vocalis::fsi {

/// The plane of contact of a cell as its deformation sees it. Π = I - N ⊗ N, N its unit normal at closing; C = ΠᵀFᵀFΠ
/// has the area stretch a = |cof(F) N| of the plane: a² = tr C when D = 2, ½ (tr² C - tr C²) when D = 3. No shear along
/// the plane, F = I + γ t ⊗ N with t · N = 0, changes C.
template <int D, class T>
struct ContactPlane {
  Matrix<D, T> projected;  ///< F Π
  Matrix<D, T> rest;       ///< I when D = 2, tr C I - C when D = 3
  Matrix<D, T> slope;      ///< ½ ∂a²/∂F = F Π rest
  T square;                ///< a²
};

/// m Π
template <int D, class T>
Matrix<D, T> in_plane(const Matrix<D, T>& m, const std::array<T, D>& normal) {
  Matrix<D, T> result = m;
  for (int i = 0; i < D; ++i) {
    T along = m[i][0] * normal[0];
    for (int k = 1; k < D; ++k) along += m[i][k] * normal[k];
    for (int k = 0; k < D; ++k) result[i][k] -= along * normal[k];
  }
  return result;
}

/// tr c I - c
template <int D, class T>
Matrix<D, T> complement(const Matrix<D, T>& c) {
  Matrix<D, T> result{};
  T trace{};
  for (int i = 0; i < D; ++i) trace += c[i][i];
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) result[i][k] = -c[i][k];
    result[i][i] += trace;
  }
  return result;
}

template <int D, class T>
ContactPlane<D, T> contact_plane(const Matrix<D, T>& f, const std::array<T, D>& normal) {
  ContactPlane<D, T> plane{};
  plane.projected = in_plane<D>(f, normal);
  if constexpr (D == 2) {
    plane.slope = plane.projected;
    plane.square = contraction<D>(plane.projected, plane.projected);
  } else {
    plane.rest = complement<D>(symmetric_product<D>(plane.projected, plane.projected));
    plane.slope = product<D>(plane.projected, plane.rest);
    // slope : F Π = tr C tr C - C : C = 2 a²
    plane.square = 0.5 * contraction<D>(plane.slope, plane.projected);
  }
  return plane;
}

/// The change of `slope` when F changes by df.
template <int D, class T>
Matrix<D, T> slope_change(const ContactPlane<D, T>& plane, const Matrix<D, T>& df, const std::array<T, D>& normal) {
  const Matrix<D, T> change = in_plane<D>(df, normal);
  if constexpr (D == 2) {
    return change;
  } else {
    Matrix<D, T> metric_change = symmetric_product<D>(plane.projected, change);
    for (auto& row : metric_change) {
      for (T& value : row) value *= 2.0;
    }
    Matrix<D, T> result = product<D>(change, plane.rest);
    const Matrix<D, T> more = product<D>(plane.projected, complement<D>(metric_change));
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) result[i][k] += more[i][k];
    }
    return result;
  }
}

/// m + mᵀ
template <int D, class T>
Matrix<D, T> twice_symmetric(const Matrix<D, T>& m) {
  Matrix<D, T> result = m;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) result[i][k] += m[k][i];
  }
  return result;
}

/// Stored energy [J/m^3] of an incompressible contact medium without friction, which resists a change of its thickness
/// J / a, and no shear along its plane:
///
///   W = ½ µ (a² + (J / a)² - 2 - 2 ln J)
///
/// That is the neo-Hookean energy of the plane strain F = diag(a, J / a), so that a layer in plane strain is as stiff
/// across as with full friction: 4 µ for small strains where J = 1, and what J the mesh lets through is resisted, too.
template <int D, class T>
T sliding_energy(const Elasticity& medium, const Matrix<D, T>& f, const std::array<T, D>& normal) {
  const T square = contact_plane<D>(f, normal).square, j = determinant<D>(f);
  return 0.5 * medium.shear * (square + j * j / square - 2.0 - 2.0 * logarithm(j));
}

/// Power [W/m^3] that viscosity takes, 2 η (a² + a⁻⁶) (∂t a)² + 2 η_f J d : d; the first part is as that of full
/// friction in the same plane strain. d = sym(Ḟ F⁻¹).
template <int D, class T>
T sliding_dissipation(const Elasticity& medium, const Matrix<D, T>& f, const Matrix<D, T>& rate_of_f,
                      const std::array<T, D>& normal) {
  const ContactPlane<D, T> plane = contact_plane<D>(f, normal);
  const T rate = contraction<D>(plane.slope, rate_of_f), inverse = 1.0 / (plane.square * plane.square);
  const Matrix<D, T> twice_d = twice_symmetric<D>(product<D>(rate_of_f, transposed<D>(cofactor<D>(f))));
  return 2 * medium.viscosity * (1.0 + inverse * inverse) * rate * rate +
         0.5 * medium.film * contraction<D>(twice_d, twice_d) / determinant<D>(f);
}

/// First Piola–Kirchhoff stress [Pa] of the contact medium without friction: with G = ½ ∂a²/∂F, d = sym(Ḟ F⁻¹),
///
///   P = (µ (1 - J² / a⁴) + 2 η (1 + a⁻⁸) G : Ḟ) G + (µ (J / a² - 1 / J) + 2 η_f d - p) J F⁻ᵀ
///
/// The film's viscosity η_f is all that holds the inside of a layer between its walls: it should be far below η.
///
/// rate_of_f  Ḟ [1/s]; pressure p [Pa]; normal  N, of unit length.
template <int D, class T>
Matrix<D, T> sliding_stress(const Elasticity& medium, const Matrix<D, T>& f, const Matrix<D, T>& rate_of_f,
                            const std::type_identity_t<T>& pressure, const std::array<T, D>& normal) {
  const ContactPlane<D, T> plane = contact_plane<D>(f, normal);
  const T inverse = 1.0 / (plane.square * plane.square);
  const Matrix<D, T> cof = cofactor<D>(f);
  const T j = determinant<D>(f), film = medium.film / j;
  const T along = medium.shear * (1.0 - j * j * inverse) +
                  2 * medium.viscosity * (1.0 + inverse * inverse) * contraction<D>(plane.slope, rate_of_f);
  const T of_cofactor = medium.shear * (j / plane.square - 1.0 / j) - pressure;
  Matrix<D, T> p = product<D>(twice_symmetric<D>(product<D>(rate_of_f, transposed<D>(cof))), cof);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) p[i][k] = along * plane.slope[i][k] + film * p[i][k] + of_cofactor * cof[i][k];
  }
  return p;
}

/// The change of `sliding_stress` when F changes by df and Ḟ by df_rate (the exact derivative in this direction).
template <int D, class T>
Matrix<D, T> sliding_stress_change(const Elasticity& medium, const Matrix<D, T>& f, const Matrix<D, T>& rate_of_f,
                                   const std::type_identity_t<T>& pressure, const std::array<T, D>& normal,
                                   const Matrix<D, T>& df, const Matrix<D, T>& df_rate) {
  const ContactPlane<D, T> plane = contact_plane<D>(f, normal);
  const Matrix<D, T> change = slope_change<D>(plane, df, normal);
  const T inverse = 1.0 / (plane.square * plane.square), square_change = 2.0 * contraction<D>(plane.slope, df);
  const T rate = contraction<D>(plane.slope, rate_of_f);
  const T rate_change = contraction<D>(change, rate_of_f) + contraction<D>(plane.slope, df_rate);
  const T damping = 2 * medium.viscosity * (1.0 + inverse * inverse);
  // J F⁻ᵀ = cof: d cof = (cof : dF) cof / J - cof dFᵀ cof / J
  const Matrix<D, T> cof = cofactor<D>(f);
  const T j = determinant<D>(f), dj = contraction<D>(cof, df);
  const T along = medium.shear * (1.0 - j * j * inverse) + damping * rate;
  // d a⁻⁴ = -2 a⁻⁶ da², d a⁻⁸ = -4 a⁻¹⁰ da²
  const T along_change =
      (2.0 * medium.shear * j * j - 8 * medium.viscosity * inverse * rate) * inverse / plane.square * square_change -
      2.0 * medium.shear * j * inverse * dj + damping * rate_change;
  const T of_cofactor = medium.shear * (j / plane.square - 1.0 / j) - pressure;
  const T of_cofactor_change = medium.shear * ((1.0 / plane.square + 1.0 / (j * j)) * dj - j * inverse * square_change);
  const Matrix<D, T> turned = product<D>(product<D>(cof, transposed<D>(df)), cof);
  Matrix<D, T> cof_change{};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) cof_change[i][k] = (dj * cof[i][k] - turned[i][k]) / j;
  }
  // The film's part is η_f / J (2 J d) cof, 2 J d = Ḟ cofᵀ + cof Ḟᵀ.
  const Matrix<D, T> twice_d = twice_symmetric<D>(product<D>(rate_of_f, transposed<D>(cof)));
  const Matrix<D, T> of_rate = twice_symmetric<D>(product<D>(df_rate, transposed<D>(cof)));
  const Matrix<D, T> of_place = twice_symmetric<D>(product<D>(rate_of_f, transposed<D>(cof_change)));
  Matrix<D, T> twice_d_change{};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) twice_d_change[i][k] = of_rate[i][k] + of_place[i][k] - dj / j * twice_d[i][k];
  }
  const Matrix<D, T> film = product<D>(twice_d, cof_change), film_change = product<D>(twice_d_change, cof);
  Matrix<D, T> dp{};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      dp[i][k] = along * change[i][k] + along_change * plane.slope[i][k] + of_cofactor * cof_change[i][k] +
                 of_cofactor_change * cof[i][k] + medium.film / j * (film[i][k] + film_change[i][k]);
    }
  }
  return dp;
}

}  // namespace vocalis::fsi
