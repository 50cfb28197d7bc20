#pragma once

#include <span>
#include <vector>

#include "contact/walls.hpp"
#include "core/fem/field.hpp"

namespace vocalis::contact {

/// The directions of ∇D at the dofs, (dofs, dimension), ghosts current: on walls `normals` (from `wall_normals`),
/// elsewhere the means of those of the cells around from which the distance comes, so less than one long where these
/// differ, and on planes of symmetry as `take_mean_on_planes` leaves them.
///
/// distance     [m] P1, ghosts current
/// coordinates  (vertices, dimension) [m], ghosts current
/// Collective.
std::vector<double> mean_directions(const fem::Field& distance, std::vector<double> normals,
                                    std::span<const double> coordinates, std::span<const SymmetryPlane> planes);

/// Leaves the directions on each plane no component across it. On a wall the mean is scaled to length one, as normals
/// are; a wall that lies in the plane keeps its own. Owners first; on return ghosts are current. Collective.
void take_mean_on_planes(const fem::Field& distance, std::span<const double> coordinates,
                         std::span<const SymmetryPlane> planes, std::vector<double>& direction);

/// How far the directions around each dof agree: in a cell 1 where the mean over its corners is 0.9 long or longer, 0
/// where it is no longer than 0.5, as on the axis between walls that meet below 60°, linear between; at a dof the mean
/// over the cells around, weighted by their measure. (dofs), ghosts current. Collective.
std::vector<double> smoothness(const fem::Space& space, std::span<const double> coordinates,
                               std::span<const double> direction);

}  // namespace vocalis::contact
