#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/fem/field.hpp"
#include "core/mesh/facets.hpp"

namespace vocalis::fem {

/// The facets of a group, each once: those of the boundary, and of those inside the mesh the side whose normal points
/// towards larger x (or y if it has no x, then z) in the reference.
std::vector<mesh::NamedFacet> facets_seen_once(const mesh::Mesh& mesh, const std::string& group);

/// ∫ v·n ds over facets [m^2/s in 2-D, m^3/s], n out of the facets' cells. Exact for the isoparametric geometry: the
/// area vector is a polynomial. Collective.
///
/// points  (dofs, dimension) [m] where the dofs of the velocity's space are now
double flux_through(const Field& velocity, std::span<const double> points, const std::vector<mesh::NamedFacet>& facets);

/// The smallest distance of the facets' vertices (and middles of edges, in a space of degree 2) from the plane where
/// coordinate `axis` is `plane` [m]. Collective.
double gap_to_plane(const Space& space, std::span<const double> points, const std::vector<mesh::NamedFacet>& facets,
                    int axis, double plane);

}  // namespace vocalis::fem
