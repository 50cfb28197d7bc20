#pragma once

#include "fsi_solver/cells/cell_batches.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi {

/// Energies and powers of fluid and solids together, all at the stage of the last step (a plane scene: per metre).
/// They balance: d(kinetic + elastic)/dt = supplied - dissipated, but for what time scheme and stabilisation lose.
struct EnergyRates {
  double kinetic = 0;     ///< ∫ ½ ρ|v|² [J]
  double elastic = 0;     ///< stored in solids [J]
  double supplied = 0;    ///< by boundaries (forces, pressures, kinetic energy that flows in) and gravity [W]
  double dissipated = 0;  ///< by viscosity of fluid and solids [W]
};

/// Facets of the fluid through which it may flow, by the corner of the cell that they are opposite to.
using OpenFacets = std::vector<CellBatches>;
OpenFacets find_open_facets(const FsiSolver& solver);

/// Zero before the first step. Collective.
EnergyRates energy(const FsiSolver& solver, const OpenFacets& open);

}  // namespace vocalis::fsi
