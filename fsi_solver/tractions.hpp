#pragma once

#include "fsi_solver/cell_input.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// β of a boundary. With ½ the inflow brings ½ρ|v|² less pressure: the given pressure is the total one, and the power
/// that enters is that pressure times the flow, whatever eddies there are.
double backflow_weight(const FlowBoundary& boundary, double at_outlets);

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
