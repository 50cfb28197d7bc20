#pragma once

#include "fsi_solver/cells/cell_batches.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi {

/// Energy that a time scheme keeps: of a mean of what there is now and what would be one step further, if all things
/// went on as in the last step. See EnergyRates.
struct KeptEnergy {
  double now = 0;    ///< at the step's end [J]
  double slope = 0;  ///< of its course from there, as a quadratic of the number of steps [J]
  double curve = 0;  ///< the same, of the square [J]
  double share = 0;  ///< [-] of what would be

  /// [J] as a step that is this many times as long as the last would have kept it.
  double value(double ratio = 1) const { return now + share * ratio * (slope + ratio * curve); }
};

/// Energies and powers of fluid and solids together, all at the stage of the last step (a plane scene: per metre).
/// They balance: d(kinetic + elastic)/dt = supplied - dissipated, but for what time scheme and stabilisation lose.
///
/// A time scheme keeps an energy of its own: in any step of a linear system without damping and load it falls by a
/// square, or stays. With E(x) = kinetic + elastic of velocities and displacements x, x⁺ at the step's end:
///
///   one-leg θ   E(x⁺)                       falls by (2θ - 1) E(x⁺ - x)
///   BDF2        ½ E(x⁺) + ½ E(2 x⁺ - x)     by ½ E(x⁺ - 2x + x₋): half a step ahead, for BDF2 remembers x
///   its first   from E(x), then ahead, too  by ½ E(x⁺ - x)
///
/// Source: Dahlquist 1978, BIT 18, 384; Hairer, Wanner 1996, Solving ODEs II, V.6 (G-stability).
struct EnergyRates {
  double kinetic = 0;     ///< ∫ ½ ρ|v|² [J]
  double elastic = 0;     ///< stored in solids [J]
  KeptEnergy kept;        ///< both as the time scheme keeps them
  double supplied = 0;    ///< by boundaries (forces, pressures, kinetic energy that flows in) and gravity [W]
  double dissipated = 0;  ///< by viscosity of fluid and solids [W]
};

/// Facets of the fluid through which it may flow, by the corner of the cell that they are opposite to.
using OpenFacets = std::vector<CellBatches>;
OpenFacets find_open_facets(const FsiSolver& solver);

/// Of the last step, which must have been accepted; zero before the first. Collective.
EnergyRates energy(const FsiSolver& solver, const OpenFacets& open);

}  // namespace vocalis::fsi
