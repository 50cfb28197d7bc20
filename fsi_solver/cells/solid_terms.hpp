#pragma once

#include "fsi_solver/cells/cell_input.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// Solid on the reference cell: ∫ (ρs a - f)·w + P : ∇w and, if incompressible, ∫ q (J tr(∇v F⁻¹) + κ (J - 1)) and the
/// subscales of a linear pressure. κ pulls the volume back, which the stabilisation would let creep under a lasting
/// load.
template <int D, int Degree>
void solid_residual(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, CellResidual<D, Degree>& out);

/// Its derivative with respect to the end velocity, p and π, (count, count) row by row.
template <int D, int Degree>
void solid_jacobian(const CellInput<D, Degree>& in, const CellStabilisation<D>& stabilisation, const Elasticity& solid,
                    bool incompressible, const Stage& stage, Lanes* matrix);

}  // namespace vocalis::fsi
