#pragma once

#include <vector>

#include "acoustic_solver/settings.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::acoustic {

/// A facet of the boundary with its condition, u·n = on_pressure p + on_potential ψ + what a wall yields, or -u·n =
/// g(t).
struct BoundaryFacet {
  std::int32_t cell = 0;     ///< owned cell
  std::int32_t index = 0;    ///< opposite to this vertex of the cell
  double on_pressure = 0;    ///< µ / (ρ c) or 1 / (ρ c) [m/(s Pa)]
  double on_potential = 0;   ///< 1 / R; 1 / (2 R) in two dimensions [1/m]
  std::int32_t wall = -1;    ///< index of the boundary of the settings that yields here; -1: none
  bool is_flux = false;      ///< the source g(t) enters here
  bool is_released = false;  ///< p = 0
  bool is_open = false;      ///< sound leaves, plane or spherical

  /// Rigid, admitting or yielding: the wall alone says what u·n is.
  bool is_wall() const { return on_potential == 0 && !is_flux && !is_released; }
};

/// The conditions on all facets without a cell behind them. The first boundary of the settings that names a facet
/// decides; a facet that none names is open behind a layer and gets the default wall admittance elsewhere.
/// Throws UserError where a boundary names a group that the mesh does not have, or a negative admittance or radius.
/// Collective.
/// Source of the open condition: the first-order radiation condition of Bayliss & Turkel 1980, exact for an outgoing
/// wave of one centre in three dimensions.
std::vector<BoundaryFacet> boundary_conditions(const mesh::Mesh& mesh, const AcousticSettings& settings);

}  // namespace vocalis::acoustic
