#pragma once

#include "fsi_solver/cells/cell_input.hpp"

namespace vocalis::fsi {

/// Orthogonal subscales of the linear pressure, which fluid and incompressible solids share:
/// ∫ τ (∇p - π)·∇q and ∫ τ (π - ∇p)·χ, lumped.
///
/// measure  of the cells [m^D]; g  gradients of the corners' basis [1/m]
template <int D>
void add_pressure_subscales(const CellInput<D, 1>& in, const CellStabilisation<D>& stabilisation, const Lanes& measure,
                            const Lanes (&g)[D + 1][D], CellResidual<D, 1>& out) {
  using E = Element<D, 1>;
  const Lanes weight = stabilisation.pressure * measure, own = weight * stabilisation.of_pressure;
  Lanes slope[D] = {}, projected[D] = {}, size{}, square{};
  for (int a = 0; a <= D; ++a) {
    for (int k = 0; k < D; ++k) {
      slope[k] += in.pressure[a] * g[a][k];
      projected[k] += in.gradient[a][k] / double{D + 1};
      size += absolute(in.pressure[a] * g[a][k]);
    }
  }
  for (int k = 0; k < D; ++k) square += g[0][k] * g[0][k];
  for (int a = 0; a <= D; ++a) {
    for (int k = 0; k < D; ++k) {
      out.values[E::pressure(a)] += own * (slope[k] - projected[k]) * g[a][k];
      out.values[E::gradient(a, k)] = weight / double{D + 1} * (in.gradient[a][k] - slope[k]);
    }
  }
  out.mass_size += own * size * square_root(square);
  out.gradient_size = weight / double{D + 1} * size;
}

/// The derivative with respect to p and π, into (count, count) matrices that are zero there.
template <int D>
void add_pressure_subscales_jacobian(const CellStabilisation<D>& stabilisation, const Lanes& measure,
                                     const Lanes (&g)[D + 1][D], Lanes* matrix) {
  using E = Element<D, 1>;
  const Lanes weight = stabilisation.pressure * measure, own = weight * stabilisation.of_pressure;
  for (int a = 0; a <= D; ++a) {
    for (int b = 0; b <= D; ++b) {
      Lanes both{};
      for (int k = 0; k < D; ++k) {
        both += g[a][k] * g[b][k];
        matrix[E::pressure(a) * E::count + E::gradient(b, k)] = -own / double{D + 1} * g[a][k];
        matrix[E::gradient(a, k) * E::count + E::pressure(b)] = -weight / double{D + 1} * g[b][k];
      }
      matrix[E::pressure(a) * E::count + E::pressure(b)] += own * both;
    }
    for (int k = 0; k < D; ++k) {
      const int row = E::gradient(a, k);
      matrix[row * E::count + row] = weight / double{D + 1};
    }
  }
}

}  // namespace vocalis::fsi
