#include "fsi_solver/cells/solid_terms.hpp"

#include <algorithm>

#include "fsi_solver/cells/pressure_subscales.hpp"
#include "fsi_solver/cells/solid_law.hpp"

namespace vocalis::fsi {

namespace {

template <int D>
struct SolidPoint {
  Matrix<D, Lanes> f, rate;
  Lanes pressure;
};

template <int D, int Degree>
SolidPoint<D> solid_point(const CellInput<D, Degree>& in, const typename Element<D, Degree>::Point& point,
                          const PointGeometry<D, Degree>& geometry, bool incompressible) {
  constexpr int nodes = Element<D, Degree>::nodes;
  SolidPoint<D> result = {gradient_of<D, nodes>(in.displacement, geometry.gradient),
                          gradient_of<D, nodes>(in.velocity, geometry.gradient), Lanes{}};
  for (int i = 0; i < D; ++i) result.f[i][i] += 1.0;
  for (int b = 0; b <= D && incompressible; ++b) result.pressure += in.pressure[b] * point.corner[b];
  return result;
}

template <int D>
Lanes dot(const std::array<Lanes, D>& a, const Lanes (&b)[D]) {
  Lanes sum = a[0] * b[0];
  for (int k = 1; k < D; ++k) sum += a[k] * b[k];
  return sum;
}

/// weight dP/d(∇v⁺), (i, l, j, k): the stress (i, l) when the gradient of v⁺ changes in its entry (j, k).
template <int D>
struct Tangent {
  Matrix<D, Lanes> of[D][D];
};
template <int D, class Law>
Tangent<D> tangent(const Law& law, const SolidPoint<D>& at, const Stage& stage) {
  Tangent<D> result;
  for (int j = 0; j < D; ++j) {
    for (int k = 0; k < D; ++k) {
      Matrix<D, Lanes> df{}, df_rate{};
      df[j][k] += stage.displacement_slope();
      df_rate[j][k] += stage.velocity_slope();
      result.of[j][k] = law.stress_change(at.f, at.rate, at.pressure, df, df_rate);
    }
  }
  return result;
}

template <int D, int Degree, class Law>
void residual_of(const Law& law, const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation,
                 const Elasticity& solid, bool incompressible, CellResidual<D, Degree>& out) {
  using E = Element<D, Degree>;
  std::fill(out.values, out.values + E::count, Lanes{});
  Lanes measure{}, growth_size{}, squares{}, lowest{};
  bool is_first = true;
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Lanes weight = point.weight * geometry.determinant;
    const SolidPoint<D> at = solid_point<D, Degree>(in, point, geometry, incompressible);
    const Lanes j = determinant<D>(at.f);
    lowest = is_first ? smaller(j, geometry.determinant) : smaller(lowest, smaller(j, geometry.determinant));
    is_first = false;
    const Matrix<D, Lanes> p = law.stress(at.f, at.rate, at.pressure);
    const auto inertia = value_of<D, E::nodes>(in.inertia, point.value);
    for (int a = 0; a < E::nodes; ++a) {
      for (int i = 0; i < D; ++i) {
        out.values[E::velocity(a, i)] += weight * (inertia[i] * point.value[a] + dot<D>(p[i], geometry.gradient[a]));
      }
    }
    measure += weight;
    squares = Lanes{};
    for (int k = 0; k < D; ++k) squares += geometry.corner_gradient[0][k] * geometry.corner_gradient[0][k];
    if (!incompressible) continue;
    const Lanes growth = contraction<D>(cofactor<D>(at.f), at.rate) + stabilisation.recovery * (j - 1.0);
    for (int b = 0; b <= D; ++b) out.values[E::pressure(b)] += weight * growth * point.corner[b];
    growth_size +=
        weight * (square_root(contraction<D>(at.rate, at.rate)) + stabilisation.recovery * absolute(j - 1.0));
  }
  Lanes speed{};
  for (const auto& value : in.velocity) {
    for (int i = 0; i < D; ++i) speed += value[i] * value[i];
  }
  speed = square_root(speed);
  const Lanes share = measure / double{E::corners}, steepness = square_root(squares);
  // Stress comes from F - F⁻ᵀ, whose rounding is far above that of small strains.
  out.momentum_size =
      uncancelled * (in.density * in.largest_rate * share * speed + uncancelled * solid.shear * measure * steepness);
  out.smallest_determinant = lowest;
  out.mass_size = growth_size / double{E::corners} + uncancelled * share * speed * steepness;
  out.gradient_size = Lanes{};
  if constexpr (E::is_stabilised) {
    if (!incompressible) return;
    const auto geometry = geometry_at<D, Degree>(E::points().front(), in.position);
    add_pressure_subscales<D>(in, stabilisation, measure, geometry.corner_gradient, out);
  }
}

template <int D, int Degree, class Law>
void jacobian_of(const Law& law, const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation,
                 bool incompressible, const Stage& stage, Lanes* matrix) {
  using E = Element<D, Degree>;
  constexpr int n = E::count;
  std::fill(matrix, matrix + n * n, Lanes{});
  Lanes measure{};
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const auto& g = geometry.gradient;
    const Lanes weight = point.weight * geometry.determinant;
    const SolidPoint<D> at = solid_point<D, Degree>(in, point, geometry, incompressible);
    const Tangent<D> change = tangent<D>(law, at, stage);
    const Matrix<D, Lanes> cof = cofactor<D>(at.f);
    const Lanes slope = stage.velocity_slope() + stabilisation.recovery * stage.displacement_slope();
    measure += weight;
    for (int a = 0; a < E::nodes; ++a) {
      Matrix<D, Lanes> of[D];  // (i, j, k)
      for (int i = 0; i < D; ++i) {
        for (int j = 0; j < D; ++j) {
          for (int k = 0; k < D; ++k) of[i][j][k] = weight * dot<D>(change.of[j][k][i], g[a]);
        }
      }
      const Lanes inertia = weight * (in.density * stage.rate * point.value[a]);
      for (int b = 0; b < E::nodes; ++b) {
        for (int i = 0; i < D; ++i) {
          Lanes* row = matrix + E::velocity(a, i) * n + E::velocity(b, 0);
          row[i] += inertia * point.value[b];
          for (int j = 0; j < D; ++j) row[j] += dot<D>(of[i][j], g[b]);
        }
      }
      for (int i = 0; i < D && incompressible; ++i) {
        const Lanes pull = weight * dot<D>(cof[i], g[a]);
        for (int b = 0; b <= D; ++b) {
          matrix[E::velocity(a, i) * n + E::pressure(b)] -= pull * point.corner[b];
          matrix[E::pressure(b) * n + E::velocity(a, i)] += slope * pull * point.corner[b];
        }
      }
    }
  }
  if constexpr (E::is_stabilised) {
    if (!incompressible) return;
    const auto geometry = geometry_at<D, Degree>(E::points().front(), in.position);
    add_pressure_subscales_jacobian<D>(stabilisation, measure, geometry.corner_gradient, matrix);
  }
}

}  // namespace

template <int D, int Degree>
void solid_residual(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, CellResidual<D, Degree>& out) {
  with_law(solid, in,
           [&](const auto& law) { residual_of<D, Degree>(law, in, stabilisation, solid, incompressible, out); });
}

template <int D, int Degree>
void solid_jacobian(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, const Stage& stage, Lanes* matrix) {
  with_law(solid, in,
           [&](const auto& law) { jacobian_of<D, Degree>(law, in, stabilisation, incompressible, stage, matrix); });
}

#define VOCALIS_INSTANTIATE(D, Degree)                                                                                 \
  template void solid_residual<D, Degree>(const CellInput<D, Degree>&, const CellStabilisation<D>&, const Elasticity&, \
                                          bool, CellResidual<D, Degree>&);                                             \
  template void solid_jacobian<D, Degree>(const CellInput<D, Degree>&, const CellStabilisation<D>&, const Elasticity&, \
                                          bool, const Stage&, Lanes*);
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
