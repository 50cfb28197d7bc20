#pragma once

#include <array>

namespace vocalis::coupling {

/// Two like vortices that turn about each other on a circle, in the x-y plane and uniform along z. Each is a Scully
/// vortex (Scully 1975, MIT ASRL TR 178-1), speed Γ r / (2π (a² + r²)) at the distance r from its middle, with the
/// core radius a. The sum has no divergence; for a -> 0 it is the pair of Müller & Obermeier 1967 (AGARD CP 22).
///
/// The pressure, with u_i the field of vortex i and V_i the velocity of its middle:
///   p = ρ Σ_i (V_i·u_i - Γ² / (8π² (a² + r_i²))) - ρ u_1·u_2 .
/// The first sum is -ρ ∂φ/∂t and each vortex' own pressure, exact with its core. What this leaves of the momentum
/// equation, ρ Du/Dt + ∇p, is known: ρ (V_1 - u_2) × ω_1 + ρ (V_2 - u_1) × ω_2. It is no more than that cores turn
/// rigidly where each would be strained by the other, and falls as (a / r)⁴ away from them; for a = 0 there is none.
struct VortexPair {
  double density = 1.2;                      ///< ρ [kg/m^3]
  double circulation = 0;                    ///< Γ of each [m^2/s]; positive: counter-clockwise
  double radius = 0;                         ///< of the circle, half of the distance between the vortices [m]
  double core_radius = 0;                    ///< a [m]
  std::array<double, 3> centre = {0, 0, 0};  ///< of the circle [m]
  double phase = 0;                          ///< angle of the first vortex at time 0 [rad]
  double rotation_rate = 0;                  ///< Ω [rad/s]; sound has twice that frequency
};

/// Ω of point vortices, Γ / (4π r₀²) [rad/s].
double rotation_rate_of_points(double circulation, double radius);

/// [m/s] at a point [m] and time [s].
std::array<double, 3> velocity(const VortexPair& pair, const std::array<double, 3>& point, double time);
/// [Pa]
double pressure(const VortexPair& pair, const std::array<double, 3>& point, double time);

}  // namespace vocalis::coupling
