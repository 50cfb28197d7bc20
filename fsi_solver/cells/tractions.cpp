#include "fsi_solver/cells/tractions.hpp"

namespace vocalis::fsi {

Traction traction_of(const FlowBoundary& boundary, const FlowSettings& settings, double time) {
  Traction result;
  result.pressure = boundary.pressure * course(boundary, time);
  if (boundary.kind == FlowBoundaryKind::total_pressure) result.backflow_weight = 0.5;
  if (boundary.kind == FlowBoundaryKind::outlet) {
    result.backflow_weight = settings.backflow_stabilisation;
    result.viscosity = settings.viscosity;
  }
  return result;
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
void add_traction(const CellInput<D, Degree>& in, int facet, const Traction& traction, CellResidual<D, Degree>& out) {
  using E = Element<D, Degree>;
  for (const typename E::Point& point : E::facet_points(facet)) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const auto area = area_at<D, Degree>(point, geometry, facet);
    const Lanes inflow = backflow<D, Degree>(in, point, area, traction.backflow_weight);
    const auto velocity = value_of<D, E::nodes>(in.velocity, point.value);
    const Matrix<D, Lanes> l = gradient_of<D, E::nodes>(in.velocity, geometry.gradient);
    for (int k = 0; k < D; ++k) {
      Lanes force = traction.pressure * area[k] + inflow * velocity[k];
      for (int j = 0; j < D; ++j) force -= traction.viscosity * l[j][k] * area[j];
      for (int a = 0; a < E::nodes; ++a) out.values[E::velocity(a, k)] += point.value[a] * force;
    }
  }
}

template <int D, int Degree>
void add_traction_jacobian(const CellInput<D, Degree>& in, int facet, const Traction& traction, const Stage& stage,
                           Lanes* matrix) {
  using E = Element<D, Degree>;
  for (const typename E::Point& point : E::facet_points(facet)) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const auto area = area_at<D, Degree>(point, geometry, facet);
    const Lanes inflow = stage.velocity_slope() * backflow<D, Degree>(in, point, area, traction.backflow_weight);
    const double viscous = stage.velocity_slope() * traction.viscosity;
    for (int a = 0; a < E::nodes; ++a) {
      for (int b = 0; b < E::nodes; ++b) {
        const Lanes both = inflow * (point.value[a] * point.value[b]);
        for (int i = 0; i < D; ++i) {
          Lanes* row = matrix + E::velocity(a, i) * E::count + E::velocity(b, 0);
          row[i] += both;
          for (int j = 0; j < D; ++j) row[j] -= viscous * point.value[a] * geometry.gradient[b][i] * area[j];
        }
      }
    }
  }
}

#define VOCALIS_INSTANTIATE(D, Degree)                                                                                \
  template void add_traction<D, Degree>(const CellInput<D, Degree>&, int, const Traction&, CellResidual<D, Degree>&); \
  template void add_traction_jacobian<D, Degree>(const CellInput<D, Degree>&, int, const Traction&, const Stage&,     \
                                                 Lanes*);
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
