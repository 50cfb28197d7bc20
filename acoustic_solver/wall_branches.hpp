#pragma once

#include <complex>
#include <span>
#include <vector>

#include "acoustic_solver/settings.hpp"

namespace vocalis::acoustic {

/// Mass, resistance and stiffness that move together under the pressure at a point of a wall, m ẅ + b ẇ + k w = p. The
/// branches of a wall stand side by side: u·n = Σ ẇ, and its admittance is Σ 1 / (m s + b + k / s) at the rate s. No
/// number is negative, so that each branch takes energy or keeps it.
struct WallBranch {
  double mass = 0;        ///< m [kg/m^2]
  double resistance = 0;  ///< b [Pa s/m]
  double stiffness = 0;   ///< k [Pa/m]

  /// Of ẇ to a change of p at the stage, where beta = θ dt: 1 / (m / beta + b + k beta) [m/(s Pa)].
  double step_admittance(double beta) const { return 1 / (mass / beta + resistance + stiffness * beta); }
};

/// Y(s) = Σ 1 / (m s + b + k / s) [m/(s Pa)], s = iω or a complex rate [1/s] other than 0.
std::complex<double> wall_admittance(std::span<const WallBranch> branches, std::complex<double> rate);

/// The branches whose sum is factor sqrt(s), to 0.7 % from 50 to 10,000 Hz in amount and phase together:
///
///   sqrt(s) = (2 / π) ∫ s / (s + x²) dx,    0 < x < ∞,
///
/// by the trapezoidal rule in ln x at six points, the rest below them as a resistance and the rest above as a
/// stiffness. Each term c s / (s + x²) is a branch of b = 1 / c and k = x² / c.
std::vector<WallBranch> square_root_branches(double factor);

/// Whether some boundary is of the kind `yielding` or `viscothermal`.
bool has_yielding_walls(const AcousticSettings& settings);

/// Of a boundary's kind `yielding` or `viscothermal`; none for another. Throws UserError where a number is out of its
/// range.
///
/// Viscothermal: Y = sqrt(iω) (sqrt(ν) + (γ - 1) sqrt(α)) / (ρ c²), with which a plane wave along walls of perimeter S
/// around an area A has k = (ω / c) (1 + (1 - i) (S / A) (sqrt(ν) + (γ - 1) sqrt(α)) / sqrt(8ω)): the attenuation and
/// delay of Kirchhoff 1868 for a tube much wider than its boundary layer. For sound that meets a wall at an angle the
/// part of ν is too large, since friction takes only the flow along the wall.
std::vector<WallBranch> wall_branches(const AcousticSettings& settings, const AcousticBoundary& boundary);

}  // namespace vocalis::acoustic
