#pragma once

#include <vector>

#include "fsi_solver/continuum.hpp"
#include "fsi_solver/state.hpp"

namespace vocalis::fsi {

/// A velocity component that a boundary prescribes.
struct PrescribedComponent {
  std::int32_t dof = 0;  ///< of the velocity
  int component = 0;
  int boundary = -1;  ///< index in the settings' boundaries, or -1: zero
  double factor = 0;  ///< profile at this dof, 1 when uniform
};

/// An exterior facet with a traction.
struct TractionFacet {
  std::int32_t cell = 0;
  int index = 0;  ///< opposite to this corner of the cell
  int boundary = 0;
};

/// What holds on the exterior boundary. Facets that no boundary names are walls in the fluid, free in solids.
struct Conditions {
  std::vector<FlowBoundary> boundaries;
  std::vector<PrescribedComponent> components;  ///< of local dofs, ghosts too; a component at most once
  std::vector<TractionFacet> tractions;         ///< of owned cells
  std::vector<char> mesh_is_held;               ///< (vertices, dimension) the mesh may not move there this way
  bool sets_pressure_level = false;             ///< some traction is given on any rank
};

/// Collective. Throws UserError if a group is not in the mesh, or a symmetry is not parallel to an axis.
Conditions make_conditions(const Continuum& continuum, const FlowSettings& settings);

/// (1 - cos(π t / ramp)) / 2, then 1; times sin(2π t / period) if there is a period.
double course(const FlowBoundary& boundary, double time);

/// Writes the prescribed components at `time` into a velocity, local values and ghosts.
///
/// coordinates  (velocity dofs, dimension) where they are then [m]
void impose(const Conditions& conditions, const Continuum& continuum, const Prescribed& prescribed,
            const std::vector<double>& coordinates, double time, fem::Field& velocity);

}  // namespace vocalis::fsi
