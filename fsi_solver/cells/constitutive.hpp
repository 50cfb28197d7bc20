#pragma once

#include <array>
#include <cmath>
#include <type_traits>

#include "fsi_solver/cells/lanes.hpp"
#include "fsi_solver/settings.hpp"

namespace vocalis::fsi {

/// Of one point, or of one point in each of several cells (T = Lanes).
template <int D, class T = double>
using Matrix = std::array<std::array<T, D>, D>;

/// The constants of a solid region as its stress needs them.
struct Elasticity {
  SolidModel model = SolidModel::neo_hookean;
  double shear = 0;      ///< µ [Pa]
  double lame = 0;       ///< λ [Pa]; 0 when incompressible
  double viscosity = 0;  ///< Kelvin–Voigt η [Pa s]
  bool slides = false;   ///< contact medium without friction, see `sliding_stress`
  double film = 0;       ///< its Newtonian viscosity η_f [Pa s]
};

/// µ = E / (2 (1 + ν)), λ = E ν / ((1 + ν)(1 - 2ν)); incompressible: µ = E / 3, λ = 0.
inline Elasticity elasticity(const SolidMaterial& material) {
  const double nu = material.incompressible ? 0.5 : material.poisson_ratio;
  const double shear = material.young_modulus / (2 * (1 + nu));
  const double lame = material.incompressible ? 0 : material.young_modulus * nu / ((1 + nu) * (1 - 2 * nu));
  return {material.model, shear, lame, material.damping, false, 0};
}

template <int D, class T>
Matrix<D, T> product(const Matrix<D, T>& a, const Matrix<D, T>& b) {
  Matrix<D, T> c{};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      for (int j = 0; j < D; ++j) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

template <int D, class T>
Matrix<D, T> transposed(const Matrix<D, T>& a) {
  Matrix<D, T> c{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) c[i][j] = a[j][i];
  }
  return c;
}

/// a : b
template <int D, class T>
T contraction(const Matrix<D, T>& a, const Matrix<D, T>& b) {
  T sum{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) sum += a[i][j] * b[i][j];
  }
  return sum;
}

/// The cofactor J F⁻ᵀ, which exists for any F.
template <int D, class T>
Matrix<D, T> cofactor(const Matrix<D, T>& f) {
  if constexpr (D == 2) {
    return {{{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}}};
  } else {
    Matrix<3, T> c{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
        c[i][j] = f[a][p] * f[b][q] - f[a][q] * f[b][p];
      }
    }
    return c;
  }
}

template <int D, class T>
T determinant(const Matrix<D, T>& f) {
  const Matrix<D, T> c = cofactor<D>(f);
  T sum{};
  for (int j = 0; j < D; ++j) sum += f[0][j] * c[0][j];
  return sum;
}

/// The symmetric part of aᵀ b.
template <int D, class T>
Matrix<D, T> symmetric_product(const Matrix<D, T>& a, const Matrix<D, T>& b) {
  const Matrix<D, T> c = product<D>(transposed<D>(a), b);
  Matrix<D, T> s{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) s[i][j] = 0.5 * (c[i][j] + c[j][i]);
  }
  return s;
}

/// λ tr(E) I + 2 µ E, for strains and for their changes and rates.
template <int D, class T>
Matrix<D, T> isotropic(double lame, double shear, const Matrix<D, T>& strain) {
  Matrix<D, T> s{};
  T trace{};
  for (int i = 0; i < D; ++i) trace += strain[i][i];
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) s[i][j] = 2 * shear * strain[i][j];
    s[i][i] += lame * trace;
  }
  return s;
}

/// ½ (FᵀF - I)
template <int D, class T>
Matrix<D, T> green_strain(const Matrix<D, T>& f) {
  Matrix<D, T> strain = symmetric_product<D>(f, f);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) strain[i][k] = 0.5 * (strain[i][k] - (i == k ? 1.0 : 0.0));
  }
  return strain;
}

/// Stored energy [J/m^3] whose derivative is the elastic part of `stress`:
///
///   neo-Hookean            ½ µ (F : F - D - 2 ln J) + ½ λ ln² J
///   Saint Venant–Kirchhoff ½ λ (tr E)² + µ E : E
template <int D, class T>
T stored_energy(const Elasticity& solid, const Matrix<D, T>& f) {
  if (solid.model == SolidModel::neo_hookean) {
    const T log_j = logarithm(determinant<D>(f));
    return 0.5 * solid.shear * (contraction<D>(f, f) - double{D} - 2.0 * log_j) + 0.5 * solid.lame * log_j * log_j;
  }
  const Matrix<D, T> strain = green_strain<D>(f);
  return 0.5 * contraction<D>(strain, isotropic<D>(solid.lame, solid.shear, strain));
}

/// First Piola–Kirchhoff stress [Pa] of a solid, plane strain when D = 2:
///
///   neo-Hookean            P = µ (F - F⁻ᵀ) + λ ln J F⁻ᵀ          (Bonet, Wood 2008, eq. 6.28)
///   Saint Venant–Kirchhoff P = F (λ tr E I + 2 µ E), E = ½(FᵀF - I)
///   Kelvin–Voigt           + F 2 η Ė, Ė = ½(ḞᵀF + FᵀḞ): zero in any rigid motion
///   pressure               - p J F⁻ᵀ
///
/// rate_of_f  Ḟ [1/s]; pressure p [Pa], 0 in compressible solids. det F must be positive.
template <int D, class T>
Matrix<D, T> stress(const Elasticity& solid, const Matrix<D, T>& f, const Matrix<D, T>& rate_of_f,
                    const std::type_identity_t<T>& pressure) {
  const Matrix<D, T> cof = cofactor<D>(f);
  const T j = determinant<D>(f);
  Matrix<D, T> p{};
  Matrix<D, T> second = isotropic<D>(0, solid.viscosity, symmetric_product<D>(rate_of_f, f));
  T of_cofactor = -pressure;
  if (solid.model == SolidModel::neo_hookean) {
    of_cofactor += (solid.lame * logarithm(j) - solid.shear) / j;
  } else {
    const Matrix<D, T> elastic = isotropic<D>(solid.lame, solid.shear, green_strain<D>(f));
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) second[i][k] += elastic[i][k];
    }
  }
  p = product<D>(f, second);
  const double of_f = solid.model == SolidModel::neo_hookean ? solid.shear : 0;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) p[i][k] += of_f * f[i][k] + of_cofactor * cof[i][k];
  }
  return p;
}

/// The change of `stress` when F changes by df and Ḟ by df_rate (the exact derivative in this direction).
template <int D, class T>
Matrix<D, T> stress_change(const Elasticity& solid, const Matrix<D, T>& f, const Matrix<D, T>& rate_of_f,
                           const std::type_identity_t<T>& pressure, const Matrix<D, T>& df,
                           const Matrix<D, T>& df_rate) {
  const Matrix<D, T> cof = cofactor<D>(f);
  const T j = determinant<D>(f);
  // d(J F⁻ᵀ) = (cof : dF) cof / J - cof dFᵀ cof / J;  dJ = cof : dF
  const T dj = contraction<D>(cof, df);
  const Matrix<D, T> turned = product<D>(product<D>(cof, transposed<D>(df)), cof);
  T of_cofactor = -pressure, change_of_factor{};
  double of_f = 0;
  Matrix<D, T> second = isotropic<D>(0, solid.viscosity, symmetric_product<D>(rate_of_f, f));
  Matrix<D, T> rate_change = symmetric_product<D>(df_rate, f);
  const Matrix<D, T> more = symmetric_product<D>(rate_of_f, df);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) rate_change[i][k] += more[i][k];
  }
  Matrix<D, T> second_change = isotropic<D>(0, solid.viscosity, rate_change);
  if (solid.model == SolidModel::neo_hookean) {
    const T factor = (solid.lame * logarithm(j) - solid.shear) / j;
    of_cofactor += factor;
    change_of_factor = (solid.lame / j - factor) * dj / j;
    of_f = solid.shear;
  } else {
    const Matrix<D, T> elastic = isotropic<D>(solid.lame, solid.shear, green_strain<D>(f));
    const Matrix<D, T> change = isotropic<D>(solid.lame, solid.shear, symmetric_product<D>(f, df));
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) {
        second[i][k] += elastic[i][k];
        second_change[i][k] += change[i][k];
      }
    }
  }
  Matrix<D, T> dp = product<D>(df, second);
  const Matrix<D, T> rest = product<D>(f, second_change);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      const T cofactor_change = (dj * cof[i][k] - turned[i][k]) / j;
      dp[i][k] += rest[i][k] + of_f * df[i][k] + of_cofactor * cofactor_change + change_of_factor * cof[i][k];
    }
  }
  return dp;
}

}  // namespace vocalis::fsi
