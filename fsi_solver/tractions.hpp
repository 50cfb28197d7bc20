#pragma once

#include "fsi_solver/cell_terms.hpp"
#include "fsi_solver/conditions.hpp"

namespace vocalis::fsi {

/// β of a boundary. With ½ the inflow brings ½ρ|v|² less pressure: the given pressure is the total one, and the power
/// that enters is that pressure times the flow, whatever eddies there are.
double backflow_weight(const FlowBoundary& boundary, double at_outlets);

/// Flow into the domain through a facet, -β ρ min(c·n, 0) |facet| with c its mean there; 0 if it flows out.
///
/// facet   the corner of the cell that it is opposite to
/// weight  β [-]
/// returns [kg/s]; in two dimensions [kg/(m s)]
/// Source: Bazilevs et al. 2009, Comput. Meth. Appl. Mech. Eng. 198, 3534.
template <int D>
double backflow(const CellInput<D>& in, int facet, double weight);

/// Part of the momentum of a facet's corners, ∫ p n·w - β ρ min(c·n, 0) v·w; the corner opposite to it has none.
///
/// pressure  given one [Pa]
/// inflow    see `backflow`
template <int D>
Corners<D> traction(const CellInput<D>& in, int facet, double pressure, double inflow);

/// Adds its derivative with respect to the end velocity at fixed inflow to a cell's matrix (see fluid_jacobian).
template <int D>
void add_traction_jacobian(int facet, double inflow, const Stage& stage, double* matrix);

}  // namespace vocalis::fsi
