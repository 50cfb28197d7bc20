#pragma once

#include <array>

#include "core/fem/simplex.hpp"
#include "fsi_solver/constitutive.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// The unknowns of a cell: velocity (corner by corner), then pressure, then the projected pressure gradient.
template <int D>
struct CellUnknowns {
  static constexpr int corners = D + 1;
  static constexpr int count = corners * (2 * D + 1);
  static constexpr int velocity(int corner, int component) { return corner * D + component; }
  static constexpr int pressure(int corner) { return corners * D + corner; }
  static constexpr int gradient(int corner, int component) { return corners * (D + 1) + corner * D + component; }
};

template <int D>
using Corners = std::array<std::array<double, D>, D + 1>;

/// What a cell's integrals are made of, all at the stage. `geometry` is the moved cell in the fluid, the reference cell
/// in a solid.
template <int D>
struct CellInput {
  fem::SimplexGeometry<D> geometry;
  Corners<D> velocity;                 ///< v_s [m/s]
  Corners<D> inertia;                  ///< ρ a_s - f [N/m^3]
  Corners<D> slip;                     ///< fluid: v_s - ∂t d [m/s]; solid: unused
  Corners<D> displacement;             ///< solid: d_s [m]; fluid: unused
  std::array<double, D + 1> pressure;  ///< [Pa]
  Corners<D> gradient;                 ///< projected pressure gradient [Pa/m]
  double largest_rate = 0;             ///< of the time scheme, 1 / dt or so [1/s]; for sizes
  double density = 0;                  ///< [kg/m^3]
};

/// Stabilisation of a cell, frozen during a step (see stabilisation.hpp).
template <int D>
struct CellStabilisation {
  double pressure = 0;                    ///< τ [m^3 s/kg]
  double stream = 0;                      ///< ρ² τ [kg s/m^3]
  double divergence = 0;                  ///< τ₂ [Pa s]
  std::array<double, D> advection = {};   ///< c [m/s]
  std::array<double, D> projection = {};  ///< projected (c·∇)v, the cell's mean [m/s^2]
};

/// A cell's part of the residual, and sizes that say what is small there: the terms' magnitudes, and a thousandth of
/// what they would be if nothing in them cancelled, below which there is only rounding.
template <int D>
struct CellResidual {
  std::array<double, CellUnknowns<D>::count> values;
  double momentum_size = 0;
  double mass_size = 0;
  double gradient_size = 0;
};

/// Fluid: ∫ (ρ a - f + ρ (c·∇)v)·w + σ : ∇w, ∫ q ∇·v, and the orthogonal subscales
///   ∫ τ (∇p - π)·∇q,  ∫ τ (π - ∇p)·χ (lumped),  ∫ ρ² τ ((c·∇)v - Π)·(c·∇w) + τ₂ ∇·v ∇·w.
template <int D>
void fluid_residual(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    CellResidual<D>& out);
/// Its derivative with respect to the end velocity, p and π at fixed geometry, (count, count) row by row.
template <int D>
void fluid_jacobian(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    const Stage& stage, double* matrix);

/// Solid on the reference cell: ∫ (ρs a - f)·w + P : ∇w and, if incompressible, ∫ q (J tr(∇v F⁻¹) + κ (J - 1)) and the
/// pressure's subscales. κ = `recovery` [1/s] pulls the volume back, which the stabilisation would let creep under a
/// lasting load. Returns false if the cell is inverted; `out` is then meaningless.
template <int D>
bool solid_residual(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, double recovery, CellResidual<D>& out);
template <int D>
void solid_jacobian(const CellInput<D>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, double recovery, const Stage& stage, double* matrix);

}  // namespace vocalis::fsi
