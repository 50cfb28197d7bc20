#include "fsi_solver/cell_terms.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::fsi {

namespace {

/// Entry of the P1 mass matrix of a simplex of measure 1.
template <int D>
constexpr double mass(int a, int b) {
  return (a == b ? 2.0 : 1.0) / ((D + 1) * (D + 2));
}

/// Σ_a x_a ⊗ ∇φ_a
template <int D>
Matrix<D> gradient_of(const fem::SimplexGeometry<D>& geometry, const Corners<D>& x) {
  Matrix<D> result{};
  for (int a = 0; a <= D; ++a) {
    for (int i = 0; i < D; ++i) {
      for (int j = 0; j < D; ++j) result[i][j] += x[a][i] * geometry.gradient[a][j];
    }
  }
  return result;
}

template <int D>
double dot(const std::array<double, D>& a, const std::array<double, D>& b) {
  double sum = 0;
  for (int i = 0; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

template <int D>
double mean(const std::array<double, D + 1>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / (D + 1);
}

/// What counts as small beside a term whose parts cancel.
constexpr double uncancelled = 1e-3;

template <int D>
double magnitude(const Corners<D>& x) {
  double sum = 0;
  for (int a = 0; a <= D; ++a) sum += dot<D>(x[a], x[a]);
  return std::sqrt(sum);
}

/// The subscales of the pressure, which fluid and incompressible solids share.
template <int D>
void add_pressure_residual(const CellInput<D>& in, double tau, CellResidual<D>& out) {
  using Unknowns = CellUnknowns<D>;
  const auto& g = in.geometry.gradient;
  const double weight = tau * in.geometry.measure;
  std::array<double, D> slope{}, projected{};
  double size = 0;
  for (int a = 0; a <= D; ++a) {
    for (int k = 0; k < D; ++k) {
      slope[k] += in.pressure[a] * g[a][k];
      projected[k] += in.gradient[a][k] / (D + 1);
      size += std::abs(in.pressure[a] * g[a][k]);
    }
  }
  for (int a = 0; a <= D; ++a) {
    for (int k = 0; k < D; ++k) {
      out.values[Unknowns::pressure(a)] += weight * (slope[k] - projected[k]) * g[a][k];
      out.values[Unknowns::gradient(a, k)] = weight / (D + 1) * (in.gradient[a][k] - slope[k]);
    }
  }
  out.mass_size += weight * size * std::sqrt(dot<D>(g[0], g[0]));
  out.gradient_size = weight / (D + 1) * size;
}

template <int D>
void add_pressure_jacobian(const fem::SimplexGeometry<D>& geometry, double tau, double* matrix) {
  using Unknowns = CellUnknowns<D>;
  const auto& g = geometry.gradient;
  const double weight = tau * geometry.measure;
  for (int a = 0; a <= D; ++a) {
    for (int b = 0; b <= D; ++b) {
      matrix[Unknowns::pressure(a) * Unknowns::count + Unknowns::pressure(b)] += weight * dot<D>(g[a], g[b]);
      for (int k = 0; k < D; ++k) {
        matrix[Unknowns::pressure(a) * Unknowns::count + Unknowns::gradient(b, k)] = -weight / (D + 1) * g[a][k];
        matrix[Unknowns::gradient(a, k) * Unknowns::count + Unknowns::pressure(b)] = -weight / (D + 1) * g[b][k];
      }
    }
    for (int k = 0; k < D; ++k) {
      const int row = Unknowns::gradient(a, k);
      matrix[row * Unknowns::count + row] = weight / (D + 1);
    }
  }
}

template <int D>
struct SolidPoint {
  Matrix<D> f, rate;
  double pressure = 0;
};

template <int D>
SolidPoint<D> solid_point(const CellInput<D>& in, bool incompressible) {
  SolidPoint<D> point = {gradient_of<D>(in.geometry, in.displacement), gradient_of<D>(in.geometry, in.velocity), 0};
  for (int i = 0; i < D; ++i) point.f[i][i] += 1;
  if (incompressible) point.pressure = mean<D>(in.pressure);
  return point;
}

}  // namespace

template <int D>
void fluid_residual(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    CellResidual<D>& out) {
  using Unknowns = CellUnknowns<D>;
  const auto& [g, measure] = in.geometry;
  const Matrix<D> l = gradient_of<D>(in.geometry, in.velocity);
  const double pressure = mean<D>(in.pressure);
  double divergence = 0;
  for (int i = 0; i < D; ++i) divergence += l[i][i];
  std::array<double, D> streaming;
  for (int i = 0; i < D; ++i) streaming[i] = dot<D>(l[i], stabilisation.advection) - stabilisation.projection[i];
  Corners<D> density_of_force = in.inertia;
  for (int a = 0; a <= D; ++a) {
    for (int i = 0; i < D; ++i) density_of_force[a][i] += in.density * dot<D>(l[i], in.slip[a]);
  }
  out.values.fill(0);
  for (int a = 0; a <= D; ++a) {
    const double stream = stabilisation.stream * dot<D>(stabilisation.advection, g[a]);
    for (int i = 0; i < D; ++i) {
      double sum = (stabilisation.divergence * divergence - pressure) * g[a][i] + stream * streaming[i];
      for (int j = 0; j < D; ++j) sum += viscosity * (l[i][j] + l[j][i]) * g[a][j];
      for (int b = 0; b <= D; ++b) sum += mass<D>(a, b) * density_of_force[b][i];
      out.values[Unknowns::velocity(a, i)] = measure * sum;
    }
    out.values[Unknowns::pressure(a)] = measure / (D + 1) * divergence;
  }
  const double rate_of_mass = measure / (D + 1) * magnitude<D>(in.velocity);
  out.momentum_size = uncancelled * in.density * rate_of_mass * in.largest_rate;
  out.mass_size =
      measure / (D + 1) * std::sqrt(contraction<D>(l, l)) + uncancelled * rate_of_mass * std::sqrt(dot<D>(g[0], g[0]));
  add_pressure_residual<D>(in, stabilisation.pressure, out);
}

template <int D>
void fluid_jacobian(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    const Stage& stage, double* matrix) {
  using Unknowns = CellUnknowns<D>;
  constexpr int n = Unknowns::count;
  const auto& [g, measure] = in.geometry;
  const Matrix<D> l = gradient_of<D>(in.geometry, in.velocity);
  const double slope = stage.velocity_slope();
  std::fill(matrix, matrix + n * n, 0.0);
  for (int a = 0; a <= D; ++a) {
    std::array<double, D> weighted_slip{};
    for (int b = 0; b <= D; ++b) {
      for (int k = 0; k < D; ++k) weighted_slip[k] += mass<D>(a, b) * in.slip[b][k];
    }
    const double stream = stabilisation.stream * dot<D>(stabilisation.advection, g[a]);
    for (int b = 0; b <= D; ++b) {
      const double same = in.density * (stage.rate * mass<D>(a, b) + slope * dot<D>(weighted_slip, g[b])) +
                          slope * (viscosity * dot<D>(g[a], g[b]) + stream * dot<D>(stabilisation.advection, g[b]));
      for (int i = 0; i < D; ++i) {
        double* row = matrix + Unknowns::velocity(a, i) * n;
        for (int j = 0; j < D; ++j) {
          row[Unknowns::velocity(b, j)] =
              measure *
              ((i == j ? same : 0.0) + slope * (in.density * mass<D>(a, b) * l[i][j] + viscosity * g[b][i] * g[a][j] +
                                                stabilisation.divergence * g[a][i] * g[b][j]));
        }
        row[Unknowns::pressure(b)] = -measure / (D + 1) * g[a][i];
        matrix[Unknowns::pressure(a) * n + Unknowns::velocity(b, i)] = slope * measure / (D + 1) * g[b][i];
      }
    }
  }
  add_pressure_jacobian<D>(in.geometry, stabilisation.pressure, matrix);
}

template <int D>
bool solid_residual(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, double recovery, CellResidual<D>& out) {
  using Unknowns = CellUnknowns<D>;
  const auto& [g, measure] = in.geometry;
  const SolidPoint<D> point = solid_point<D>(in, incompressible);
  const double j = determinant<D>(point.f);
  if (!(j > 0)) return false;
  const Matrix<D> p = stress<D>(solid, point.f, point.rate, point.pressure);
  out.values.fill(0);
  for (int a = 0; a <= D; ++a) {
    for (int i = 0; i < D; ++i) {
      double sum = dot<D>(p[i], g[a]);
      for (int b = 0; b <= D; ++b) sum += mass<D>(a, b) * in.inertia[b][i];
      out.values[Unknowns::velocity(a, i)] = measure * sum;
    }
  }
  // Stress comes from F - F⁻ᵀ, whose rounding is far above that of small strains.
  out.momentum_size = uncancelled * (in.density * measure / (D + 1) * magnitude<D>(in.velocity) * in.largest_rate +
                                     uncancelled * solid.shear * measure * std::sqrt(dot<D>(g[0], g[0])));
  out.mass_size = out.gradient_size = 0;
  if (!incompressible) return true;
  const double growth = contraction<D>(cofactor<D>(point.f), point.rate) + recovery * (j - 1);
  for (int a = 0; a <= D; ++a) out.values[Unknowns::pressure(a)] = measure / (D + 1) * growth;
  out.mass_size = measure / (D + 1) *
                  (std::sqrt(contraction<D>(point.rate, point.rate)) + recovery * std::abs(j - 1) +
                   uncancelled * magnitude<D>(in.velocity) * std::sqrt(dot<D>(g[0], g[0])));
  add_pressure_residual<D>(in, stabilisation.pressure, out);
  return true;
}

template <int D>
void solid_jacobian(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, double recovery, const Stage& stage, double* matrix) {
  using Unknowns = CellUnknowns<D>;
  constexpr int n = Unknowns::count;
  const auto& [g, measure] = in.geometry;
  const SolidPoint<D> point = solid_point<D>(in, incompressible);
  const double velocity_slope = stage.velocity_slope(), displacement_slope = stage.displacement_slope();
  std::fill(matrix, matrix + n * n, 0.0);
  for (int j = 0; j < D; ++j) {
    for (int k = 0; k < D; ++k) {
      // Stress when the gradient of v⁺ changes in its entry (j, k).
      Matrix<D> df{}, df_rate{};
      df[j][k] = displacement_slope;
      df_rate[j][k] = velocity_slope;
      const Matrix<D> dp = stress_change<D>(solid, point.f, point.rate, point.pressure, df, df_rate);
      for (int a = 0; a <= D; ++a) {
        for (int i = 0; i < D; ++i) {
          const double value = measure * dot<D>(dp[i], g[a]);
          double* row = matrix + Unknowns::velocity(a, i) * n;
          for (int b = 0; b <= D; ++b) row[Unknowns::velocity(b, j)] += value * g[b][k];
        }
      }
    }
  }
  for (int a = 0; a <= D; ++a) {
    for (int b = 0; b <= D; ++b) {
      for (int i = 0; i < D; ++i) {
        matrix[Unknowns::velocity(a, i) * n + Unknowns::velocity(b, i)] +=
            measure * in.density * stage.rate * mass<D>(a, b);
      }
    }
  }
  if (!incompressible) return;
  const Matrix<D> cof = cofactor<D>(point.f);
  const double slope = velocity_slope + recovery * displacement_slope;
  for (int a = 0; a <= D; ++a) {
    for (int i = 0; i < D; ++i) {
      const double pull = measure / (D + 1) * dot<D>(cof[i], g[a]);
      for (int b = 0; b <= D; ++b) {
        matrix[Unknowns::velocity(a, i) * n + Unknowns::pressure(b)] = -pull;
        matrix[Unknowns::pressure(b) * n + Unknowns::velocity(a, i)] = slope * pull;
      }
    }
  }
  add_pressure_jacobian<D>(in.geometry, stabilisation.pressure, matrix);
}

#define VOCALIS_INSTANTIATE(D)                                                                                       \
  template void fluid_residual<D>(const CellInput<D>&, const CellStabilisation<D>&, double, CellResidual<D>&);       \
  template void fluid_jacobian<D>(const CellInput<D>&, const CellStabilisation<D>&, double, const Stage&, double*);  \
  template bool solid_residual<D>(const CellInput<D>&, const CellStabilisation<D>&, const Elasticity&, bool, double, \
                                  CellResidual<D>&);                                                                 \
  template void solid_jacobian<D>(const CellInput<D>&, const CellStabilisation<D>&, const Elasticity&, bool, double, \
                                  const Stage&, double*);
VOCALIS_INSTANTIATE(2)
VOCALIS_INSTANTIATE(3)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
