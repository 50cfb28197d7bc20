#pragma once

#include <string>
#include <vector>

#include "coupling/monitors/fold_profile.hpp"
#include "coupling/monitors/monitor_settings.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::coupling {

/// The glottis between two vocal folds, or between one and its mirror image in a plane.
struct Glottis {
  struct Fold {
    std::vector<mesh::NamedFacet> facets;  ///< of its surface, from the fluid
    int side = 1;                          ///< +1: it lies on the side of large coordinates
  };
  MonitorSettings settings;
  std::vector<Fold> folds;  ///< one, before the plane; or two
  FoldGrid grid;
};

/// What is open between the folds. Where contact cells touch the folds' surfaces, nothing is: the gap that the mesh
/// leaves there is no way for air. Sizes are of the whole glottis, also of a mirrored half.
struct GlottalOpening {
  std::vector<double> areas;  ///< (stations) [m^2]; in the plane, as of a metre of depth, [m]. NaN where no fold is
  double area = 0;            ///< the smallest of them
  double gap = 0;             ///< [m] smallest distance over the whole grid
  int narrowest = 0;          ///< station of the smallest area; the middle one of the longest row where all is sealed
  double low = 0, high = 0;   ///< [m] where the folds (or the plane) are at the narrowest station, contact cells or not
};

/// Finds the folds on the mesh at rest. Collective. Throws UserError for groups that the flow mesh does not have or no
/// fluid touches, folds that do not face each other, and axes that the mesh does not have.
///
/// cell_is_fluid  of local cells, ghosts too; contact cells are fluid
Glottis make_glottis(const fsi::FsiSolver& flow, const MonitorSettings& settings,
                     const std::vector<std::int32_t>& cell_is_fluid);

/// Of the accepted state. Collective.
///
/// points  (velocity dofs, dimension) [m] where they are now
GlottalOpening measure_opening(const fsi::FsiSolver& flow, const Glottis& glottis, std::span<const double> points);

/// In the plane: the volume flow [m^2/s] towards larger coordinates `along` through the narrowest place, relative to
/// the mesh, which there goes with folds and contact cells: what passes a glottis that is closed. Mean over the last
/// step of length Δt: ∫ ((vⁿ + vⁿ⁻¹)/2 - (dⁿ - dⁿ⁻¹)/Δt)·n ds. Collective.
double flow_past_folds(const fsi::FsiSolver& flow, const Glottis& glottis, const GlottalOpening& opening,
                       std::span<const double> points, const std::vector<std::int32_t>& cell_is_fluid);

/// The values of the monitor, in the order of `columns_of`. Collective.
std::vector<double> glottis_values(const fsi::FsiSolver& flow, const Glottis& glottis, std::span<const double> points,
                                   const std::vector<std::int32_t>& cell_is_fluid);

}  // namespace vocalis::coupling
