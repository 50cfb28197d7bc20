#pragma once

#include "fsi_solver/cells/cell_input.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// Fluid: ∫ (ρ a - f + ρ (c·∇)v)·w + σ : ∇w, ∫ q ∇·v, and the orthogonal subscales
///   ∫ ρ² τ ((c·∇)v - Π)·(c·∇w) + τ₂ ∇·v ∇·w, and those of the pressure where it is linear like the velocity.
template <int D, int Degree>
void fluid_residual(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    CellResidual<D, Degree>& out);

/// Its derivative with respect to the end velocity, p and π at fixed geometry, (count, count) row by row.
template <int D, int Degree>
void fluid_jacobian(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, double viscosity,
                    const Stage& stage, Lanes* matrix);

}  // namespace vocalis::fsi
