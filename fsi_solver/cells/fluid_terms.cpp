#include "fsi_solver/cells/fluid_terms.hpp"

#include <algorithm>

#include "fsi_solver/cells/pressure_subscales.hpp"

namespace vocalis::fsi {

namespace {

template <int D>
Lanes trace(const Matrix<D, Lanes>& l) {
  Lanes sum = l[0][0];
  for (int i = 1; i < D; ++i) sum += l[i][i];
  return sum;
}

/// ∇v c
template <int D>
std::array<Lanes, D> along(const Matrix<D, Lanes>& l, const Lanes* c) {
  std::array<Lanes, D> result{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) result[i] += l[i][j] * c[j];
  }
  return result;
}

/// c·∇φ_a
template <int D>
Lanes along(const Lanes* c, const Lanes (&g)[D]) {
  Lanes sum = c[0] * g[0];
  for (int k = 1; k < D; ++k) sum += c[k] * g[k];
  return sum;
}

/// (c·∇)v - Π at a point
template <int D>
std::array<Lanes, D> streaming(const CellStabilisation<D>& stabilisation, const Matrix<D, Lanes>& l,
                               const double (&corner)[D + 1]) {
  std::array<Lanes, D> result = along<D>(l, stabilisation.advection);
  for (int b = 0; b <= D; ++b) {
    for (int i = 0; i < D; ++i) result[i] -= stabilisation.projection[b][i] * corner[b];
  }
  return result;
}

template <int D, int Degree>
Lanes magnitude(const Lanes (&x)[Element<D, Degree>::nodes][D]) {
  Lanes sum{};
  for (const auto& value : x) {
    for (int i = 0; i < D; ++i) sum += value[i] * value[i];
  }
  return square_root(sum);
}

}  // namespace

template <int D, int Degree>
void fluid_residual(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    CellResidual<D, Degree>& out) {
  using E = Element<D, Degree>;
  std::fill(out.values, out.values + E::count, Lanes{});
  Lanes measure{}, strain{}, lowest{}, squares{};
  bool is_first = true;
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const auto& g = geometry.gradient;
    lowest = is_first ? geometry.determinant : smaller(lowest, geometry.determinant);
    is_first = false;
    const Lanes weight = point.weight * geometry.determinant;
    const Matrix<D, Lanes> l = gradient_of<D, E::nodes>(in.velocity, g);
    const auto slip = value_of<D, E::nodes>(in.slip, point.value);
    auto force = value_of<D, E::nodes>(in.inertia, point.value);
    const auto convection = along<D>(l, slip.data());
    const auto stream = streaming<D>(stabilisation, l, point.corner);
    const Lanes divergence = trace<D>(l);
    Lanes pressure{};
    for (int b = 0; b <= D; ++b) pressure += in.pressure[b] * point.corner[b];
    Matrix<D, Lanes> stress{};
    for (int i = 0; i < D; ++i) {
      force[i] = weight * (force[i] + in.density * convection[i]);
      for (int j = 0; j < D; ++j) {
        stress[i][j] =
            weight * (viscosity * (l[i][j] + l[j][i]) + stabilisation.stream * stream[i] * stabilisation.advection[j]);
      }
      stress[i][i] += weight * (stabilisation.divergence * divergence - pressure);
    }
    for (int a = 0; a < E::nodes; ++a) {
      for (int i = 0; i < D; ++i) {
        Lanes sum = force[i] * point.value[a];
        for (int j = 0; j < D; ++j) sum += stress[i][j] * g[a][j];
        out.values[E::velocity(a, i)] += sum;
      }
    }
    for (int b = 0; b <= D; ++b) out.values[E::pressure(b)] += weight * divergence * point.corner[b];
    measure += weight;
    strain += weight * contraction<D>(l, l);
    squares = along<D>(geometry.corner_gradient[0], geometry.corner_gradient[0]);
  }
  const Lanes rate_of_mass = measure / double{E::corners} * magnitude<D, Degree>(in.velocity);
  out.smallest_determinant = lowest;
  out.momentum_size = uncancelled * in.density * in.largest_rate * rate_of_mass;
  out.mass_size =
      square_root(measure * strain) / double{E::corners} + uncancelled * rate_of_mass * square_root(squares);
  out.gradient_size = Lanes{};
  if constexpr (E::is_stabilised) {
    const auto geometry = geometry_at<D, Degree>(E::points().front(), in.position);
    add_pressure_subscales<D>(in, stabilisation, measure, geometry.corner_gradient, out);
  }
}

template <int D, int Degree>
void fluid_jacobian(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    const Stage& stage, Lanes* matrix) {
  using E = Element<D, Degree>;
  constexpr int n = E::count;
  const double slope = stage.velocity_slope();
  std::fill(matrix, matrix + n * n, Lanes{});
  Lanes measure{};
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const auto& g = geometry.gradient;
    const Lanes weight = point.weight * geometry.determinant, sloped = slope * weight;
    const Matrix<D, Lanes> l = gradient_of<D, E::nodes>(in.velocity, g);
    const auto slip = value_of<D, E::nodes>(in.slip, point.value);
    measure += weight;
    for (int a = 0; a < E::nodes; ++a) {
      const Lanes of_value = in.density * point.value[a] * sloped;
      const Lanes of_rate = in.density * point.value[a] * stage.rate * weight;
      const Lanes of_stream = sloped * stabilisation.stream * along<D>(stabilisation.advection, g[a]);
      Lanes viscous[D], divergent[D];
      for (int k = 0; k < D; ++k) {
        viscous[k] = sloped * viscosity * g[a][k];
        divergent[k] = sloped * stabilisation.divergence * g[a][k];
      }
      for (int b = 0; b < E::nodes; ++b) {
        const Lanes same = of_rate * point.value[b] + of_value * along<D>(slip.data(), g[b]) + along<D>(viscous, g[b]) +
                           of_stream * along<D>(stabilisation.advection, g[b]);
        for (int i = 0; i < D; ++i) {
          Lanes* row = matrix + E::velocity(a, i) * n + E::velocity(b, 0);
          row[i] += same;
          for (int j = 0; j < D; ++j) {
            row[j] += of_value * point.value[b] * l[i][j] + viscous[j] * g[b][i] + divergent[i] * g[b][j];
          }
        }
      }
      for (int b = 0; b <= D; ++b) {
        const Lanes pulled = weight * point.corner[b];
        for (int i = 0; i < D; ++i) {
          matrix[E::velocity(a, i) * n + E::pressure(b)] -= pulled * g[a][i];
          matrix[E::pressure(b) * n + E::velocity(a, i)] += slope * pulled * g[a][i];
        }
      }
    }
  }
  if constexpr (E::is_stabilised) {
    const auto geometry = geometry_at<D, Degree>(E::points().front(), in.position);
    add_pressure_subscales_jacobian<D>(stabilisation, measure, geometry.corner_gradient, matrix);
  }
}

#define VOCALIS_INSTANTIATE(D, Degree)                                                                      \
  template void fluid_residual<D, Degree>(const CellInput<D, Degree>&, const CellStabilisation<D>&, double, \
                                          CellResidual<D, Degree>&);                                        \
  template void fluid_jacobian<D, Degree>(const CellInput<D, Degree>&, const CellStabilisation<D>&, double, \
                                          const Stage&, Lanes*);
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
