#pragma once

#include <array>
#include <cmath>

#include "fsi_solver/settings.hpp"

namespace vocalis::fsi {

template <int D>
using Matrix = std::array<std::array<double, D>, D>;

/// The constants of a solid region as its stress needs them.
struct Elasticity {
  SolidModel model = SolidModel::neo_hookean;
  double shear = 0;      ///< µ [Pa]
  double lame = 0;       ///< λ [Pa]; 0 when incompressible
  double viscosity = 0;  ///< Kelvin–Voigt η [Pa s]
};

/// µ = E / (2 (1 + ν)), λ = E ν / ((1 + ν)(1 - 2ν)); incompressible: µ = E / 3, λ = 0.
inline Elasticity elasticity(const SolidMaterial& material) {
  const double nu = material.incompressible ? 0.5 : material.poisson_ratio;
  const double shear = material.young_modulus / (2 * (1 + nu));
  const double lame = material.incompressible ? 0 : material.young_modulus * nu / ((1 + nu) * (1 - 2 * nu));
  return {material.model, shear, lame, material.damping};
}

template <int D>
Matrix<D> product(const Matrix<D>& a, const Matrix<D>& b) {
  Matrix<D> c{};
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      for (int j = 0; j < D; ++j) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

template <int D>
Matrix<D> transposed(const Matrix<D>& a) {
  Matrix<D> c{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) c[i][j] = a[j][i];
  }
  return c;
}

/// a : b
template <int D>
double contraction(const Matrix<D>& a, const Matrix<D>& b) {
  double sum = 0;
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) sum += a[i][j] * b[i][j];
  }
  return sum;
}

/// The cofactor J F⁻ᵀ, which exists for any F.
template <int D>
Matrix<D> cofactor(const Matrix<D>& f) {
  if constexpr (D == 2) {
    return {{{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}}};
  } else {
    Matrix<3> c{};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, p = (j + 1) % 3, q = (j + 2) % 3;
        c[i][j] = f[a][p] * f[b][q] - f[a][q] * f[b][p];
      }
    }
    return c;
  }
}

template <int D>
double determinant(const Matrix<D>& f) {
  const Matrix<D> c = cofactor<D>(f);
  double sum = 0;
  for (int j = 0; j < D; ++j) sum += f[0][j] * c[0][j];
  return sum;
}

/// The symmetric part of aᵀ b.
template <int D>
Matrix<D> symmetric_product(const Matrix<D>& a, const Matrix<D>& b) {
  const Matrix<D> c = product<D>(transposed<D>(a), b);
  Matrix<D> s{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) s[i][j] = 0.5 * (c[i][j] + c[j][i]);
  }
  return s;
}

/// λ tr(E) I + 2 µ E, for strains and for their changes and rates.
template <int D>
Matrix<D> isotropic(double lame, double shear, const Matrix<D>& strain) {
  Matrix<D> s{};
  double trace = 0;
  for (int i = 0; i < D; ++i) trace += strain[i][i];
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) s[i][j] = 2 * shear * strain[i][j];
    s[i][i] += lame * trace;
  }
  return s;
}

/// First Piola–Kirchhoff stress [Pa] of a solid, plane strain when D = 2:
///
///   neo-Hookean            P = µ (F - F⁻ᵀ) + λ ln J F⁻ᵀ          (Bonet, Wood 2008, eq. 6.28)
///   Saint Venant–Kirchhoff P = F (λ tr E I + 2 µ E), E = ½(FᵀF - I)
///   Kelvin–Voigt           + F 2 η Ė, Ė = ½(ḞᵀF + FᵀḞ): zero in any rigid motion
///   pressure               - p J F⁻ᵀ
///
/// rate_of_f  Ḟ [1/s]; pressure p [Pa], 0 in compressible solids. det F must be positive.
template <int D>
Matrix<D> stress(const Elasticity& solid, const Matrix<D>& f, const Matrix<D>& rate_of_f, double pressure) {
  const Matrix<D> cof = cofactor<D>(f);
  const double j = determinant<D>(f);
  Matrix<D> p{};
  Matrix<D> second = isotropic<D>(0, solid.viscosity, symmetric_product<D>(rate_of_f, f));
  double of_cofactor = -pressure;
  if (solid.model == SolidModel::neo_hookean) {
    of_cofactor += (solid.lame * std::log(j) - solid.shear) / j;
  } else {
    Matrix<D> strain = symmetric_product<D>(f, f);
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) strain[i][k] = 0.5 * (strain[i][k] - (i == k));
    }
    const Matrix<D> elastic = isotropic<D>(solid.lame, solid.shear, strain);
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
template <int D>
Matrix<D> stress_change(const Elasticity& solid, const Matrix<D>& f, const Matrix<D>& rate_of_f, double pressure,
                        const Matrix<D>& df, const Matrix<D>& df_rate) {
  const Matrix<D> cof = cofactor<D>(f);
  const double j = determinant<D>(f);
  // d(J F⁻ᵀ) = (cof : dF) cof / J - cof dFᵀ cof / J;  dJ = cof : dF
  const double dj = contraction<D>(cof, df);
  const Matrix<D> turned = product<D>(product<D>(cof, transposed<D>(df)), cof);
  double of_cofactor = -pressure, change_of_factor = 0, of_f = 0;
  Matrix<D> second = isotropic<D>(0, solid.viscosity, symmetric_product<D>(rate_of_f, f));
  Matrix<D> rate_change = symmetric_product<D>(df_rate, f);
  const Matrix<D> more = symmetric_product<D>(rate_of_f, df);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) rate_change[i][k] += more[i][k];
  }
  Matrix<D> second_change = isotropic<D>(0, solid.viscosity, rate_change);
  if (solid.model == SolidModel::neo_hookean) {
    const double factor = (solid.lame * std::log(j) - solid.shear) / j;
    of_cofactor += factor;
    change_of_factor = (solid.lame / j - factor) * dj / j;
    of_f = solid.shear;
  } else {
    Matrix<D> strain = symmetric_product<D>(f, f);
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) strain[i][k] = 0.5 * (strain[i][k] - (i == k));
    }
    const Matrix<D> elastic = isotropic<D>(solid.lame, solid.shear, strain);
    const Matrix<D> change = isotropic<D>(solid.lame, solid.shear, symmetric_product<D>(f, df));
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) {
        second[i][k] += elastic[i][k];
        second_change[i][k] += change[i][k];
      }
    }
  }
  Matrix<D> dp = product<D>(df, second);
  const Matrix<D> rest = product<D>(f, second_change);
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) {
      const double cofactor_change = (dj * cof[i][k] - turned[i][k]) / j;
      dp[i][k] += rest[i][k] + of_f * df[i][k] + of_cofactor * cofactor_change + change_of_factor * cof[i][k];
    }
  }
  return dp;
}

}  // namespace vocalis::fsi
