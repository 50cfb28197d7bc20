#pragma once

#include <span>
#include <vector>

#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi {

/// How contact cells are loaded at the stage of the last step, as means over each cell. With N the unit normal of the
/// contact when it closed, n = F⁻ᵀN / |F⁻ᵀN| and σ = P Fᵀ / J. Owned cells; 0 in cells that are not in contact.
struct ContactLoad {
  std::vector<double> normal_stress;   ///< n·σ·n [Pa], negative under pressure
  std::vector<double> fluid_pressure;  ///< [Pa] of the fluid beside: a mean, NaN in a cell that touches none
  double lowest_fluid_pressure = 0;    ///< [Pa] beside any contact cell; 0 if there is none
};

/// normal  (owned cells, dimension) N
/// Collective. The phases must still be those of the step.
ContactLoad contact_load(const FsiSolver& solver, std::span<const double> normal);

}  // namespace vocalis::fsi
