#pragma once

#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// The facets of a named group, seen from the cells of this mesh, inner ones from both sides.
std::vector<NamedFacet> facets_of_group(const Mesh& mesh, const std::string& group);

/// Those of a named group without a cell behind them on any rank: where the mesh ends.
std::vector<NamedFacet> exterior_facets_of_group(const Mesh& mesh, const std::string& group);

/// All facets without a cell behind them, each with its group or -1. A facet of two groups is listed with the first.
std::vector<NamedFacet> boundary_facets(const Mesh& mesh);

/// Whether each local vertex lies on one of the facets, on any rank. Collective.
std::vector<std::int32_t> mark_vertices(const Mesh& mesh, const std::vector<NamedFacet>& facets);

/// Whether each local vertex belongs to one of the marked owned cells, on any rank. Collective.
std::vector<std::int32_t> mark_vertices_of_cells(const Mesh& mesh, const std::vector<std::int32_t>& cell_is_marked);

}  // namespace vocalis::mesh
