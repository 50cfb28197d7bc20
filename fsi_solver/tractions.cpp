#include "fsi_solver/tractions.hpp"

#include <algorithm>

namespace vocalis::fsi {

namespace {

/// Entry of the P1 mass matrix of a facet of measure 1.
template <int D>
constexpr double facet_mass(int a, int b) {
  return (a == b ? 2.0 : 1.0) / (D * (D + 1));
}

}  // namespace

double backflow_weight(const FlowBoundary& boundary, double at_outlets) {
  if (boundary.kind == FlowBoundaryKind::total_pressure) return 0.5;
  return boundary.kind == FlowBoundaryKind::outlet ? at_outlets : 0;
}

template <int D>
double backflow(const CellInput<D>& in, int facet, double weight) {
  double through = 0;
  for (int a = 0; a <= D; ++a) {
    if (a == facet) continue;
    for (int k = 0; k < D; ++k) through -= in.slip[a][k] * in.geometry.gradient[facet][k];
  }
  // n |facet| = -D |cell| ∇φ_facet; the mean over D corners cancels D.
  return -weight * in.density * std::min(0.0, through * in.geometry.measure);
}

template <int D>
Corners<D> traction(const CellInput<D>& in, int facet, double pressure, double inflow) {
  Corners<D> result{};
  for (int a = 0; a <= D; ++a) {
    if (a == facet) continue;
    for (int k = 0; k < D; ++k) {
      double value = -pressure * in.geometry.measure * in.geometry.gradient[facet][k];
      for (int b = 0; b <= D; ++b) {
        if (b != facet) value += inflow * facet_mass<D>(a, b) * in.velocity[b][k];
      }
      result[a][k] = value;
    }
  }
  return result;
}

template <int D>
void add_traction_jacobian(int facet, double inflow, const Stage& stage, double* matrix) {
  using Unknowns = CellUnknowns<D>;
  for (int a = 0; a <= D; ++a) {
    for (int b = 0; b <= D; ++b) {
      if (a == facet || b == facet) continue;
      for (int k = 0; k < D; ++k) {
        matrix[Unknowns::velocity(a, k) * Unknowns::count + Unknowns::velocity(b, k)] +=
            stage.velocity_slope() * inflow * facet_mass<D>(a, b);
      }
    }
  }
}

#define VOCALIS_INSTANTIATE(D)                                               \
  template double backflow<D>(const CellInput<D>&, int, double);             \
  template Corners<D> traction<D>(const CellInput<D>&, int, double, double); \
  template void add_traction_jacobian<D>(int, double, const Stage&, double*);
VOCALIS_INSTANTIATE(2)
VOCALIS_INSTANTIATE(3)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
