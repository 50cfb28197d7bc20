#pragma once

#include "fsi_solver/cells/cell_input.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

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

/// What acts on a boundary.
struct Traction {
  double pressure = 0;  ///< given one [Pa]
  /// β [-]. With ½ the inflow brings ½ρ|v|² less pressure: the given pressure is the total one, and the power that
  /// enters is that pressure times the flow, whatever eddies there are.
  double backflow_weight = 0;
  double viscosity = 0;  ///< µ at an outlet, which parallel flow leaves undisturbed; else 0
};
Traction traction_of(const FlowBoundary& boundary, const FlowSettings& settings, double time);

/// Adds to the momentum of cells, of which each has a facet with a traction opposite to the same corner,
/// ∫ p n·w - β ρ min(c·n, 0) v·w - µ (∇vᵀ n)·w.
///
/// Sources: Bazilevs et al. 2009, Comput. Meth. Appl. Mech. Eng. 198, 3534 (β); Heywood, Rannacher, Turek 1996, Int. J.
/// Numer. Meth. Fluids 22, 325 (the last term, which makes of σ n = -p n the "do nothing" µ ∂v/∂n = (p' - p) n).
template <int D, int Degree>
void add_traction(const CellInput<D, Degree>& in, int facet, const Traction& traction, CellResidual<D, Degree>& out);

/// Adds its derivative with respect to the end velocity at fixed inflow to the cells' matrices (see fluid_jacobian).
template <int D, int Degree>
void add_traction_jacobian(const CellInput<D, Degree>& in, int facet, const Traction& traction, const Stage& stage,
                           Lanes* matrix);

}  // namespace vocalis::fsi
