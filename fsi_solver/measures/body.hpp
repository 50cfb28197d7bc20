#pragma once

#include <array>
#include <string>
#include <vector>

#include "fsi_solver/cells/cell_batches.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::fsi {

/// A surface in the flow whose force is wanted: rigid walls, interfaces with solids, or both.
struct Body {
  std::vector<std::int32_t> is_on_it;  ///< (velocity dofs)
  CellBatches cells;                   ///< the fluid cells that touch it
};

/// groups  of facets that make the surface
/// Collective. Throws UserError for a group that the flow mesh does not have, or that no fluid touches.
Body make_body(const FsiSolver& solver, const std::vector<std::string>& groups);

/// Force of the fluid on a body [N] (a plane flow: [N/m]) at the stage of the last step: minus the residual of the
/// fluid's momentum against the functions that are 1 on the body, which is as accurate as the energy, one order more
/// than the integral of the stress. Zero before the first step. Collective.
/// Source: John 2004, Int. J. Numer. Meth. Fluids 44, 777; Giles, Larson, Levenstam, Süli 1997, Oxford NA-97/06.
std::array<double, 3> force_on(const FsiSolver& solver, const Body& body);

}  // namespace vocalis::fsi
