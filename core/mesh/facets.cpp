#include "core/mesh/facets.hpp"

#include <algorithm>

#include "core/mesh/geometry.hpp"

namespace vocalis::mesh {

namespace {

void share_marks(const Mesh& mesh, std::vector<std::int32_t>& marks) {
  mesh.vertex_halo.max_to_owners(marks);
  mesh.vertex_halo.copy_to_ghosts(marks);
}

}  // namespace

std::vector<NamedFacet> facets_of_group(const Mesh& mesh, const std::string& group) {
  const int wanted = index_of(mesh.group_names, group);
  std::vector<NamedFacet> result;
  std::copy_if(mesh.named_facets.begin(), mesh.named_facets.end(), std::back_inserter(result),
               [&](const NamedFacet& facet) { return facet.group == wanted; });
  return result;
}

std::vector<NamedFacet> exterior_facets_of_group(const Mesh& mesh, const std::string& group) {
  std::vector<NamedFacet> facets = facets_of_group(mesh, group);
  std::erase_if(facets, [&](const NamedFacet& facet) {
    return mesh.cell_neighbours[static_cast<std::size_t>(facet.cell) * (mesh.dimension + 1) + facet.index] >= 0;
  });
  return facets;
}

std::vector<NamedFacet> boundary_facets(const Mesh& mesh) {
  const int facets = mesh.dimension + 1;
  std::vector<std::int32_t> group_of_facet(mesh.cell_neighbours.size(), -1);
  for (const NamedFacet& facet : mesh.named_facets) {
    std::int32_t& group = group_of_facet[static_cast<std::size_t>(facet.cell) * facets + facet.index];
    if (group < 0) group = facet.group;
  }
  std::vector<NamedFacet> result;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (int i = 0; i < facets; ++i) {
      const std::size_t position = static_cast<std::size_t>(cell) * facets + i;
      if (mesh.cell_neighbours[position] < 0) result.push_back({cell, i, group_of_facet[position]});
    }
  }
  return result;
}

std::vector<std::int32_t> mark_vertices(const Mesh& mesh, const std::vector<NamedFacet>& facets) {
  std::vector<std::int32_t> marks(mesh.num_vertices(), 0);
  for (const NamedFacet& facet : facets) {
    const auto corners = facet_vertices(mesh, facet.cell, facet.index);
    for (int i = 0; i < mesh.dimension; ++i) marks[corners[i]] = 1;
  }
  share_marks(mesh, marks);
  return marks;
}

std::vector<std::int32_t> mark_vertices_of_cells(const Mesh& mesh, const std::vector<std::int32_t>& cell_is_marked) {
  std::vector<std::int32_t> marks(mesh.num_vertices(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!cell_is_marked[cell]) continue;
    for (const std::int32_t vertex : mesh.vertices_of(cell)) marks[vertex] = 1;
  }
  share_marks(mesh, marks);
  return marks;
}

}  // namespace vocalis::mesh
