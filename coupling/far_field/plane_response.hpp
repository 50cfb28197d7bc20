#pragma once

#include <vector>

namespace vocalis::coupling {

/// Sound in the plane, where a wave never ends: sources are lines, whose distant parts are heard later. With the
/// two-dimensional Green's function H(t - τ) / (2π sqrt(t² - τ²)), τ = r / c,
///
///   p of a line that gives off the mass q(t) [kg/(s m)]:   1 / (2π) ∫ q'(t - T) / sqrt(T² - τ²) dT,            T > τ
///   p of a line with the force f(t) towards the point [N/m]: 1 / (2π r) ∫ f'(t - T) T / sqrt(T² - τ²) dT,
///
/// the second after an integration by parts of f'(t - T) / T + f(t - T) / T². Both are silent before time 0. These are
/// the pressures of q' = t and f' = t, that is, the kernels' second integrals, from the arrival of the front to the
/// time `since` [s] after it; of a rate that is linear between equally spaced instants all is made of them. (Of sources
/// that are linear there themselves, with their constant rates, only the order 3/2 would be left: the kernels are
/// infinite at the front.)
///
/// Source: Morse, Ingard 1968, Theoretical Acoustics, 7.3 (line source in the time domain).
double line_mass_response(double since, double delay);                          ///< for q'' = 1 [s]
double line_force_response(double since, double delay, double speed_of_sound);  ///< for f'' = 1 [s^2/m]

/// Delays τ [s] at which the responses are computed to interpolate those of all delays in between: Chebyshev points, so
/// many that the error is below 1e-6 of a response (it falls with the distance to the singularity at τ = 0).
std::vector<double> response_delays(double least, double largest);

/// Weights of the responses at `nodes` for that at a delay (Lagrange).
std::vector<double> interpolation_weights(const std::vector<double>& nodes, double delay);

}  // namespace vocalis::coupling
