#pragma once

#include <span>

#include "fsi_solver/continuum.hpp"
#include "fsi_solver/state.hpp"

namespace vocalis::fsi {

/// Cells that close catch the air in them, as an inelastic impact does: points that were fluid and now belong to a
/// contact cell go on with the velocity at which the mesh moved there, (d - d₋) / dt₋, and without acceleration, for
/// from now on their displacement is the integral of their velocity.
///
/// dof_solid_before  Continuum::dof_solid before the cells closed
/// Returns the kinetic energy that is lost by this [J; in the plane J/m]. Collective.
double capture(const Continuum& continuum, std::span<const std::int32_t> dof_solid_before, double density,
               State& state);

}  // namespace vocalis::fsi
