#pragma once

#include "coupling/analogies/analogy.hpp"

namespace vocalis::coupling {

/// Which part of the momentum that the flow carries is a force on the air.
enum class CarriedMomentum {
  whole,  ///< div(u u): the divergence of Lighthill's tensor over ρ
  lamb    ///< div(u u) - ∇|u|²/2, which is the Lamb vector ω × u as div u = 0
};

/// The source of a wave equation for the total pressure, whose momentum is ρ ∂t u + ∇p = -ρ div(u u) + ρν Δu:
///
///   load_k = -∫_fluid div(u u)·∇φ_k dx - ∫_walls ∂t u·n φ_k ds - ∫_walls ν (n × ω)·∇φ_k ds
///
/// the second by parts of the momentum normal to boundaries of the fluid, at a fixed point: ∂t u = ∂t u|χ - β·∇u; the
/// third all of the viscous force, see `add_wall_friction`. At the outlet into the air momentum goes on, and there is
/// no such term.
///
/// u u is interpolated between its values at the vertices, and in the middles of edges if they are known, so that the
/// total force of a region is the flux of momentum through its rim, to rounding: a low-Mach quadrupole is what is left
/// when such forces cancel.
///
/// velocity  (vertices, d) of the flow at one end of the step [m/s]
/// of_edges  (edges, d) in their middles; empty: not known
void add_carried_momentum(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which,
                          const std::vector<double>& velocity, const std::vector<double>& of_edges, fem::Load& load);
void add_wall_acceleration(const FlowView& flow, fem::Load& load);

/// What of it is of the velocity alone, the first and the third.
void add_forces(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which,
                const std::vector<double>& velocity, const std::vector<double>& of_edges, fem::Load& load);

/// All of it, at both ends of the step.
AnalogySource force_source(const FlowView& flow, const AnalogyMedium& medium, CarriedMomentum which);

}  // namespace vocalis::coupling
