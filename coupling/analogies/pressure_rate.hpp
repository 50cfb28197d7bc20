#pragma once

#include "coupling/analogies/analogy.hpp"

namespace vocalis::coupling {

/// Source density of the pressure-rate analogy [1/s]:
///
///   Q = -(1 / (ρ c²)) (∂t p|χ - β·∇p)
///
/// The rate seen from a moving mesh point, ∂t p|χ [Pa/s], less β·∇p [Pa/s] is the rate at a fixed point of space.
/// Mass conservation of p_total = p_ic + p_a with div u_ic = 0 gives the minus sign; Degirmenci 2018, section 3.3,
/// prints a plus, with which p_ic + p_a is not the pressure in a duct (see tests/verification).
inline double pressure_rate_density(double rate_on_mesh, double mesh_velocity_dot_gradient, double density,
                                    double speed_of_sound) {
  return -(rate_on_mesh - mesh_velocity_dot_gradient) / (density * speed_of_sound * speed_of_sound);
}

/// The pressure-rate analogy (Degirmenci 2018, eq. 3.1, with the sign of Ribner 1962):
///
///   load_k = ∫_fluid Q φ_k dx + ∫_outlet u_ic·n φ_k ds
///
/// The rate over the step is the difference of its two pressures, so that the source's integral in time is exact. The
/// outlet is where the flow region ends inside the air (n points out of the flow): without its flux the mouth's sound
/// is lost. Across a change of phase ∂t p is none: Q is 0 in cells that are or were in contact and at their vertices,
/// and β·∇p is left out in cells with such a vertex, whose ∇p is not the air's.
class PressureRate : public Analogy {
 public:
  PressureRate(double density, double speed_of_sound) : density_(density), speed_of_sound_(speed_of_sound) {}
  AnalogySource source(const FlowView& flow) const override;

 private:
  double density_;
  double speed_of_sound_;
};

}  // namespace vocalis::coupling
