#pragma once

#include <array>

#include "acoustic_solver/sources/gaussian_pulse.hpp"

namespace vocalis::coupling {

/// The incompressible flow that a piston at x = start drives along x, through a duct of constant section that is open,
/// p = 0, at x = start + length: u(t) the same everywhere, p = ρ u'(t) (start + length - x).
struct DuctPiston {
  double density = 1.2;           ///< ρ [kg/m^3]
  acoustic::GaussianPulse pulse;  ///< u(t) [m/s], see acoustic::GaussianFlux
  double start = 0;               ///< [m]
  double length = 0;              ///< [m]
};

/// [m/s] at a point [m] and time [s].
std::array<double, 3> velocity(const DuctPiston& duct, const std::array<double, 3>& point, double time);
/// [Pa]
double pressure(const DuctPiston& duct, const std::array<double, 3>& point, double time);

}  // namespace vocalis::coupling
