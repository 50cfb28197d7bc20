#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::transfer {

/// The part of a parent mesh that was kept, a distributed mesh by itself, and the way to and from its parent. Maps to
/// the parent have one entry per local entity here; maps from the parent one per local entity there, -1 where this
/// rank has no kept cell at the entity (another rank may have one). Ghost cells are in the cell maps, too.
struct StrippedMesh {
  mesh::Mesh mesh;
  std::vector<std::int32_t> vertex_to_parent, parent_to_vertex;
  std::vector<std::int32_t> edge_to_parent, parent_to_edge;
  std::vector<std::int32_t> cell_to_parent, parent_to_cell;
};

/// Keeps some cells of a mesh, each on the rank that has it.
///
/// A vertex or edge survives where a kept cell touches it, and belongs to the lowest rank with a kept cell there, even
/// if the parent's owner is another one. On each rank the owned entities come first, then the ghosts, both in the
/// parent's order. A facet whose neighbour was not kept has no neighbour any more and keeps its groups; names of
/// regions and groups are those of the parent, in the same order; so are the middles of curved edges. Any rank, or all,
/// may keep nothing.
///
/// keep_cell  (owned cells of the parent) not 0: keep
/// Collective: four passes over the parent's halo and one scan for each kind of entity.
StrippedMesh strip(const mesh::Mesh& parent, std::span<const std::int32_t> keep_cell);

/// Takes the coordinates of the parent's vertices, whose ghosts must be current; so are those here. The middles of
/// curved edges stay where they were. No messages.
///
/// parent_coordinates  (parent vertices, dimension) [m]
void follow(StrippedMesh& stripped, std::span<const double> parent_coordinates);

}  // namespace vocalis::transfer
