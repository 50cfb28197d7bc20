#include "core/fem/space.hpp"

#include <algorithm>
#include <cassert>
#include <unordered_map>

#include "core/base/mpi.hpp"

namespace vocalis::fem {

namespace {

/// The vertices and edges of a mesh as one list of entities with global keys.
struct Entities {
  const mesh::Mesh& mesh;
  std::int64_t num_labels;

  std::int64_t key(std::int32_t entity, bool is_edge, std::int64_t label) const {
    const std::int64_t number =
        is_edge ? mesh.vertices.num_global + mesh.edges.to_global(entity) : mesh.vertices.to_global(entity);
    return number * num_labels + label;
  }
};

}  // namespace

Space lagrange(const mesh::Mesh& mesh, int degree) {
  const std::vector<std::int32_t> labels(mesh.num_cells(), 0);
  return lagrange(mesh, degree, labels);
}

Space lagrange(const mesh::Mesh& mesh, int degree, std::span<const std::int32_t> cell_label) {
  assert(degree == 1 || degree == 2);
  Space space;
  space.mesh = &mesh;
  space.degree = degree;
  const int corners = mesh.dimension + 1;
  const int edges = degree == 2 ? static_cast<int>(mesh::edges_of_cell(mesh.dimension).size()) : 0;
  space.dofs_per_cell = corners + edges;

  std::int64_t highest = 0;
  for (const std::int32_t label : cell_label) highest = std::max<std::int64_t>(highest, label);
  const Entities entities = {mesh, base::largest(mesh.comm, highest) + 1};

  // Vertices in the order of the mesh, then edges: with one label the numbering of degree 1 is that of the vertices.
  struct Candidate {
    std::int64_t key;
    std::int32_t vertex, edge, label;
  };
  std::vector<Candidate> candidates;
  std::unordered_map<std::int64_t, std::int32_t> seen;
  const auto add = [&](std::int32_t entity, bool is_edge, std::int32_t label) {
    const std::int64_t key = entities.key(entity, is_edge, label);
    if (!seen.try_emplace(key, 0).second) return;
    candidates.push_back({key, is_edge ? -1 : entity, is_edge ? entity : -1, label});
  };
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (cell_label[cell] < 0) continue;
    for (const std::int32_t vertex : mesh.vertices_of(cell)) add(vertex, false, cell_label[cell]);
    const std::size_t first_edge = static_cast<std::size_t>(cell) * mesh::edges_of_cell(mesh.dimension).size();
    for (int e = 0; e < edges; ++e) add(mesh.cell_edges[first_edge + e], true, cell_label[cell]);
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    if ((a.edge < 0) != (b.edge < 0)) return a.edge < 0;
    return a.edge < 0 ? std::pair(a.vertex, a.label) < std::pair(b.vertex, b.label)
                      : std::pair(a.edge, a.label) < std::pair(b.edge, b.label);
  });

  std::vector<std::int64_t> keys;
  keys.reserve(candidates.size());
  for (const Candidate& candidate : candidates) keys.push_back(candidate.key);
  const base::SharedNumbering numbering = base::number_shared(mesh.comm, keys);
  space.dofs = numbering.map;
  space.halo = base::Halo(space.dofs);
  space.dof_vertex.resize(keys.size());
  space.dof_edge.resize(keys.size());
  space.dof_label.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::int32_t dof = numbering.key_to_local[i];
    seen[keys[i]] = dof;
    space.dof_vertex[dof] = candidates[i].vertex;
    space.dof_edge[dof] = candidates[i].edge;
    space.dof_label[dof] = candidates[i].label;
  }
  space.cell_dofs.assign(static_cast<std::size_t>(mesh.num_cells()) * space.dofs_per_cell, -1);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int32_t label = cell_label[cell];
    if (label < 0) continue;
    std::int32_t* dofs = space.cell_dofs.data() + static_cast<std::size_t>(cell) * space.dofs_per_cell;
    for (const std::int32_t vertex : mesh.vertices_of(cell)) *dofs++ = seen.at(entities.key(vertex, false, label));
    const std::size_t first_edge = static_cast<std::size_t>(cell) * mesh::edges_of_cell(mesh.dimension).size();
    for (int e = 0; e < edges; ++e) *dofs++ = seen.at(entities.key(mesh.cell_edges[first_edge + e], true, label));
  }
  return space;
}

std::vector<double> dof_points(const Space& space) {
  const mesh::Mesh& mesh = *space.mesh;
  const int d = mesh.dimension;
  std::vector<double> points(static_cast<std::size_t>(space.num_dofs()) * d);
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    for (int k = 0; k < d; ++k) {
      double& value = points[static_cast<std::size_t>(dof) * d + k];
      if (space.dof_vertex[dof] >= 0) {
        value = mesh.point(space.dof_vertex[dof])[k];
      } else if (!mesh.edge_points.empty()) {
        value = mesh.edge_points[static_cast<std::size_t>(space.dof_edge[dof]) * d + k];
      } else {
        const std::int32_t* ends = mesh.edge_vertices.data() + 2 * space.dof_edge[dof];
        value = 0.5 * (mesh.point(ends[0])[k] + mesh.point(ends[1])[k]);
      }
    }
  }
  return points;
}

}  // namespace vocalis::fem
