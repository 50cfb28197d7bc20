#include "transfer/strip.hpp"

#include <algorithm>
#include <cassert>

#include "core/base/mpi.hpp"
#include "transfer/surviving_entities.hpp"

namespace vocalis::transfer {

namespace {

/// Kept cells in the parent's order, then the ghosts across their facets. Cells stay with their rank, so only their
/// new numbers travel. Collective.
void keep_cells(const mesh::Mesh& parent, std::span<const std::int32_t> keep_cell, StrippedMesh& result) {
  mesh::Mesh& mesh = result.mesh;
  std::vector<std::int32_t> index_at_owner(parent.cells.num_local(), -1);
  for (std::int32_t cell = 0; cell < parent.num_cells(); ++cell) {
    if (!keep_cell[cell]) continue;
    index_at_owner[cell] = static_cast<std::int32_t>(result.cell_to_parent.size());
    result.cell_to_parent.push_back(cell);
  }
  mesh.cells = base::contiguous_index_map(parent.comm, static_cast<std::int32_t>(result.cell_to_parent.size()));
  const std::vector<std::int64_t> offsets = base::gather_all(parent.comm, mesh.cells.offset);
  parent.cell_halo.copy_to_ghosts(index_at_owner);

  // A kept ghost whose only neighbours here were stripped is nobody's neighbour any more.
  const int facets = parent.dimension + 1;
  std::vector<std::int32_t> is_neighbour(parent.cells.num_local(), 0);
  for (const std::int32_t cell : result.cell_to_parent) {
    for (int i = 0; i < facets; ++i) {
      const std::int32_t other = parent.cell_neighbours[static_cast<std::size_t>(cell) * facets + i];
      if (other >= parent.num_cells()) is_neighbour[other] = 1;
    }
  }
  result.parent_to_cell = index_at_owner;
  for (std::int32_t cell = parent.num_cells(); cell < parent.cells.num_local(); ++cell) {
    result.parent_to_cell[cell] = -1;
    if (!is_neighbour[cell] || index_at_owner[cell] < 0) continue;
    const int owner = parent.cells.ghost_owner[cell - parent.num_cells()];
    result.parent_to_cell[cell] = mesh.cells.num_local();
    result.cell_to_parent.push_back(cell);
    mesh.cells.ghost_owner.push_back(owner);
    mesh.cells.ghost_global.push_back(offsets[owner] + index_at_owner[cell]);
  }
  mesh.cell_halo = base::Halo(mesh.cells);
  for (const std::int32_t cell : result.cell_to_parent) mesh.cell_region.push_back(parent.cell_region[cell]);
}

/// Marks the entities that the kept cells of this rank touch.
std::vector<std::int32_t> claim(const StrippedMesh& stripped, const std::vector<std::int32_t>& entities_of_cell,
                                std::size_t entities_a_cell, std::int32_t num_entities) {
  std::vector<std::int32_t> claimed(num_entities, 0);
  for (std::int32_t cell = 0; cell < stripped.mesh.num_cells(); ++cell) {
    const auto first = entities_of_cell.begin() + stripped.cell_to_parent[cell] * entities_a_cell;
    std::for_each(first, first + entities_a_cell, [&](std::int32_t entity) { claimed[entity] = 1; });
  }
  return claimed;
}

/// The entries of the kept cells, each taken through a map; entries of -1 stay.
std::vector<std::int32_t> rename(const StrippedMesh& stripped, const std::vector<std::int32_t>& entries_of_cell,
                                 std::size_t entries_a_cell, const std::vector<std::int32_t>& new_name) {
  std::vector<std::int32_t> result;
  result.reserve(stripped.mesh.num_cells() * entries_a_cell);
  for (std::int32_t cell = 0; cell < stripped.mesh.num_cells(); ++cell) {
    const auto first = entries_of_cell.begin() + stripped.cell_to_parent[cell] * entries_a_cell;
    std::transform(first, first + entries_a_cell, std::back_inserter(result),
                   [&](std::int32_t entry) { return entry < 0 ? -1 : new_name[entry]; });
  }
  return result;
}

}  // namespace

StrippedMesh strip(const mesh::Mesh& parent, std::span<const std::int32_t> keep_cell) {
  assert(keep_cell.size() == static_cast<std::size_t>(parent.num_cells()));
  StrippedMesh result;
  mesh::Mesh& mesh = result.mesh;
  mesh.comm = parent.comm;
  mesh.dimension = parent.dimension;
  mesh.region_names = parent.region_names;
  mesh.group_names = parent.group_names;
  keep_cells(parent, keep_cell, result);

  const std::size_t corners = parent.dimension + 1;
  SurvivingEntities vertices =
      survive(parent.vertices, parent.vertex_halo, claim(result, parent.cell_vertices, corners, parent.num_vertices()));
  mesh.vertices = std::move(vertices.map);
  mesh.vertex_halo = base::Halo(mesh.vertices);
  result.vertex_to_parent = std::move(vertices.to_parent);
  result.parent_to_vertex = std::move(vertices.from_parent);

  const std::size_t edges_a_cell = mesh::edges_of_cell(parent.dimension).size();
  SurvivingEntities edges =
      survive(parent.edges, parent.edge_halo, claim(result, parent.cell_edges, edges_a_cell, parent.edges.num_local()));
  mesh.edges = std::move(edges.map);
  mesh.edge_halo = base::Halo(mesh.edges);
  result.edge_to_parent = std::move(edges.to_parent);
  result.parent_to_edge = std::move(edges.from_parent);

  mesh.cell_vertices = rename(result, parent.cell_vertices, corners, result.parent_to_vertex);
  mesh.cell_edges = rename(result, parent.cell_edges, edges_a_cell, result.parent_to_edge);
  mesh.cell_neighbours = rename(result, parent.cell_neighbours, corners, result.parent_to_cell);
  for (const std::int32_t edge : result.edge_to_parent) {
    for (int end = 0; end < 2; ++end) {
      mesh.edge_vertices.push_back(result.parent_to_vertex[parent.edge_vertices[2 * edge + end]]);
    }
  }
  if (!parent.edge_points.empty()) {
    for (const std::int32_t edge : result.edge_to_parent) {
      const auto point = parent.edge_points.begin() + static_cast<std::ptrdiff_t>(edge) * parent.dimension;
      mesh.edge_points.insert(mesh.edge_points.end(), point, point + parent.dimension);
    }
  }
  for (const std::int32_t vertex : result.vertex_to_parent) mesh.vertex_input.push_back(parent.vertex_input[vertex]);
  for (const mesh::NamedFacet& facet : parent.named_facets) {
    const std::int32_t cell = result.parent_to_cell[facet.cell];
    if (cell >= 0) mesh.named_facets.push_back({cell, facet.index, facet.group});
  }
  follow(result, parent.coordinates);
  return result;
}

void follow(StrippedMesh& stripped, std::span<const double> parent_coordinates) {
  const std::size_t d = stripped.mesh.dimension;
  assert(parent_coordinates.size() == stripped.parent_to_vertex.size() * d);
  stripped.mesh.coordinates.resize(stripped.vertex_to_parent.size() * d);
  for (std::size_t vertex = 0; vertex < stripped.vertex_to_parent.size(); ++vertex) {
    std::copy_n(parent_coordinates.begin() + stripped.vertex_to_parent[vertex] * d, d,
                stripped.mesh.coordinates.begin() + vertex * d);
  }
}

}  // namespace vocalis::transfer
