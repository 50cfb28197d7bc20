#include "fsi_solver/tractions.hpp"

#include <algorithm>

namespace vocalis::fsi {

double backflow_weight(const FlowBoundary& boundary, double at_outlets) {
  if (boundary.kind == FlowBoundaryKind::total_pressure) return 0.5;
  return boundary.kind == FlowBoundaryKind::outlet ? at_outlets : 0;
}

namespace {

/// -β ρ min(c·n, 0) at a point [kg/s].
template <int D, int Degree>
Lanes backflow(const CellInput<D, Degree>& in, const typename Element<D, Degree>::Point& point,
               const std::array<Lanes, D>& area, double weight) {
  const auto slip = value_of<D, Element<D, Degree>::nodes>(in.slip, point.value);
  Lanes through{};
  for (int k = 0; k < D; ++k) through += slip[k] * area[k];
  return -weight * in.density * smaller(through, Lanes{});
}

}  // namespace

template <int D, int Degree>
void add_traction(const CellInput<D, Degree>& in, int facet, double pressure, double weight,
                  CellResidual<D, Degree>& out) {
  using E = Element<D, Degree>;
  for (const typename E::Point& point : E::facet_points(facet)) {
    const auto area = area_at<D, Degree>(point, geometry_at<D, Degree>(point, in.position), facet);
    const Lanes inflow = backflow<D, Degree>(in, point, area, weight);
    const auto velocity = value_of<D, E::nodes>(in.velocity, point.value);
    for (int a = 0; a < E::nodes; ++a) {
      for (int k = 0; k < D; ++k) {
        out.values[E::velocity(a, k)] += point.value[a] * (pressure * area[k] + inflow * velocity[k]);
      }
    }
  }
}

template <int D, int Degree>
void add_traction_jacobian(const CellInput<D, Degree>& in, int facet, double weight, const Stage& stage,
                           Lanes* matrix) {
  using E = Element<D, Degree>;
  for (const typename E::Point& point : E::facet_points(facet)) {
    const auto area = area_at<D, Degree>(point, geometry_at<D, Degree>(point, in.position), facet);
    const Lanes inflow = stage.velocity_slope() * backflow<D, Degree>(in, point, area, weight);
    for (int a = 0; a < E::nodes; ++a) {
      for (int b = 0; b < E::nodes; ++b) {
        const Lanes both = inflow * (point.value[a] * point.value[b]);
        for (int k = 0; k < D; ++k) matrix[E::velocity(a, k) * E::count + E::velocity(b, k)] += both;
      }
    }
  }
}

#define VOCALIS_INSTANTIATE(D, Degree)                                                                               \
  template void add_traction<D, Degree>(const CellInput<D, Degree>&, int, double, double, CellResidual<D, Degree>&); \
  template void add_traction_jacobian<D, Degree>(const CellInput<D, Degree>&, int, double, const Stage&, Lanes*);
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
