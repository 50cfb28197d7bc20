#pragma once

#include "fsi_solver/cells/element.hpp"

namespace vocalis::fsi {

/// What the integrals of several cells are made of, all at the stage. `position` is that of the moved cell in the
/// fluid, of the reference cell in a solid.
template <int D, int Degree>
struct CellInput {
  static constexpr int nodes = Element<D, Degree>::nodes;
  Lanes position[nodes][D];      ///< [m]
  Lanes velocity[nodes][D];      ///< v_s [m/s]
  Lanes inertia[nodes][D];       ///< ρ a_s - f [N/m^3]
  Lanes slip[nodes][D];          ///< fluid: v_s - ∂t d [m/s]; solid: unused
  Lanes displacement[nodes][D];  ///< solid: d_s [m]; fluid: unused
  Lanes pressure[D + 1];         ///< [Pa]
  Lanes gradient[D + 1][D];      ///< projected pressure gradient [Pa/m]; degree 1 only
  double largest_rate = 0;       ///< of the time scheme, 1 / dt or so [1/s]; for sizes
  double density = 0;            ///< [kg/m^3]
  std::array<Lanes, D> normal;   ///< contact cells without friction: N at closing; others: unused
};

/// Stabilisation of several cells, frozen during a step (see stabilisation.hpp).
template <int D>
struct CellStabilisation {
  Lanes pressure;              ///< τ [m^3 s/kg]
  Lanes stream;                ///< ρ² τ [kg s/m^3]
  Lanes divergence;            ///< τ₂ [Pa s]
  Lanes recovery;              ///< κ of incompressible solids [1/s]
  Lanes advection[D];          ///< c [m/s]
  Lanes projection[D + 1][D];  ///< projected (c·∇)v at the corners [m/s^2]
  double of_pressure = 1;      ///< 0 leaves the pressure without its stabilisation
};

/// What counts as small beside a term whose parts cancel.
inline constexpr double uncancelled = 1e-3;

/// Parts of the residual of several cells, and sizes that say what is small there: the terms' magnitudes, and a
/// thousandth of what they would be if nothing in them cancelled, below which there is only rounding.
template <int D, int Degree>
struct CellResidual {
  Lanes values[Element<D, Degree>::count];
  Lanes momentum_size;
  Lanes mass_size;
  Lanes gradient_size;
  Lanes smallest_determinant;  ///< of the map from the reference cell, and in solids of F, over the points
};

}  // namespace vocalis::fsi
