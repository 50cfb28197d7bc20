#pragma once

#include <span>

#include "coupling/analogies/analogy.hpp"

namespace vocalis::coupling {

/// Source density of sound that the pressure of an incompressible flow leaves behind [1/s]:
///
///   Q = -(1 / (ρ c²)) (∂t p|χ - w·∇p)
///
/// The rate seen from a moving mesh point, ∂t p|χ [Pa/s], less w·∇p [Pa/s]. With w = β, the mesh's velocity, that is
/// the rate at a fixed point of space, with w = β - U that of air carried by U. Mass conservation of p_ic + p_a with
/// div u_ic = 0 gives the minus sign; Degirmenci 2018, section 3.3, prints a plus, with which p_ic + p_a is not the
/// pressure in a duct.
inline double pressure_source_density(double rate_on_mesh, double velocity_dot_gradient, const AnalogyMedium& medium) {
  return -(rate_on_mesh - velocity_dot_gradient) / (medium.density * medium.speed_of_sound * medium.speed_of_sound);
}

/// load_k = ∫_fluid Q φ_k dx + ∫_outlet u_ic·n φ_k ds at both ends of the step, with the geometry of mid-step.
///
/// The outlet is where the flow region ends inside the air (n points out of the flow): without its flux the mouth's
/// sound is lost. Across a change of phase ∂t p is none: Q is 0 in cells that are or were in contact and at their
/// vertices, and w·∇p is left out in cells with such a vertex, whose ∇p is not the air's.
///
/// velocity  (vertices, d) w [m/s], throughout the step
AnalogySource pressure_source(const FlowView& flow, const AnalogyMedium& medium, std::span<const double> velocity);

}  // namespace vocalis::coupling
