#pragma once

#include "fsi_solver/cell_input.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// β of a boundary. With ½ the inflow brings ½ρ|v|² less pressure: the given pressure is the total one, and the power
/// that enters is that pressure times the flow, whatever eddies there are.
double backflow_weight(const FlowBoundary& boundary, double at_outlets);

/// Outward normal times the weight of a point of the facet [m^(D-1)]: -D |cell| ∇λ_facet of a straight cell.
template <int D, int Degree>
std::array<Lanes, D> area_at(const typename Element<D, Degree>::Point& point, const PointGeometry<D, Degree>& geometry,
                             int facet) {
  constexpr double measure = D == 2 ? 0.5 : 1.0 / 6;
  std::array<Lanes, D> result;
  for (int k = 0; k < D; ++k) {
    result[k] = -D * measure * point.weight * geometry.determinant * geometry.corner_gradient[facet][k];
  }
  return result;
}

/// Adds to the momentum of cells, of which each has a facet with a traction opposite to the same corner,
/// ∫ p n·w - β ρ min(c·n, 0) v·w.
///
/// pressure  given one [Pa]; weight  β [-]
/// Source: Bazilevs et al. 2009, Comput. Meth. Appl. Mech. Eng. 198, 3534.
template <int D, int Degree>
void add_traction(const CellInput<D, Degree>& in, int facet, double pressure, double weight,
                  CellResidual<D, Degree>& out);

/// Adds its derivative with respect to the end velocity at fixed inflow to the cells' matrices (see fluid_jacobian).
template <int D, int Degree>
void add_traction_jacobian(const CellInput<D, Degree>& in, int facet, double weight, const Stage& stage, Lanes* matrix);

}  // namespace vocalis::fsi
