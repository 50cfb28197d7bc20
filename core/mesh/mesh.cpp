#include "core/mesh/mesh.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <map>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "core/mesh/neighbours.hpp"

namespace vocalis::mesh {

namespace {

constexpr std::array<std::array<int, 2>, 3> triangle_edges = {{{0, 1}, {1, 2}, {2, 0}}};
constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

/// Vertices: owned first, coordinates in that order; cells made to have positive volume.
void number_vertices(Mesh& mesh, const MeshPart& part) {
  const base::SharedNumbering numbering = base::number_shared(mesh.comm, part.vertex_input);
  mesh.vertices = numbering.map;
  mesh.vertex_halo = base::Halo(mesh.vertices);
  const int d = mesh.dimension;
  mesh.coordinates.resize(part.coordinates.size());
  mesh.vertex_input.resize(part.vertex_input.size());
  for (std::size_t i = 0; i < part.vertex_input.size(); ++i) {
    const std::size_t local = numbering.key_to_local[i];
    mesh.vertex_input[local] = part.vertex_input[i];
    std::copy_n(part.coordinates.begin() + i * d, d, mesh.coordinates.begin() + local * d);
  }
  mesh.cell_vertices.reserve(part.cell_vertices.size());
  for (const std::int32_t vertex : part.cell_vertices) mesh.cell_vertices.push_back(numbering.key_to_local[vertex]);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    std::int32_t* vertices = mesh.cell_vertices.data() + static_cast<std::size_t>(cell) * (d + 1);
    if (signed_volume(mesh, {vertices, static_cast<std::size_t>(d + 1)}) < 0) std::swap(vertices[d - 1], vertices[d]);
  }
}

void number_edges(Mesh& mesh) {
  std::map<std::array<std::int64_t, 2>, std::int32_t> edge_of_vertices;
  std::vector<std::int64_t> keys;
  std::vector<std::array<std::int32_t, 2>> ends;
  const auto pairs = edges_of_cell(mesh.dimension);
  mesh.cell_edges.reserve(mesh.num_cells() * pairs.size());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    for (const auto& [a, b] : pairs) {
      std::array<std::int32_t, 2> end = {vertices[a], vertices[b]};
      std::array<std::int64_t, 2> global = {mesh.vertices.to_global(end[0]), mesh.vertices.to_global(end[1])};
      if (global[0] > global[1]) {
        std::swap(global[0], global[1]);
        std::swap(end[0], end[1]);
      }
      const auto [entry, is_new] = edge_of_vertices.try_emplace(global, static_cast<std::int32_t>(keys.size()));
      if (is_new) {
        keys.push_back(global[0] * mesh.vertices.num_global + global[1]);
        ends.push_back(end);
      }
      mesh.cell_edges.push_back(entry->second);
    }
  }
  const base::SharedNumbering numbering = base::number_shared(mesh.comm, keys);
  mesh.edges = numbering.map;
  mesh.edge_halo = base::Halo(mesh.edges);
  mesh.edge_vertices.resize(2 * ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    std::copy_n(ends[i].begin(), 2, mesh.edge_vertices.begin() + 2 * numbering.key_to_local[i]);
  }
  for (std::int32_t& edge : mesh.cell_edges) edge = numbering.key_to_local[edge];
}

/// The middles of all edges, if any edge of any rank is curved. Copies agree, for every part has the same point.
void place_edge_points(Mesh& mesh, const MeshPart& part) {
  const int d = mesh.dimension;
  std::map<std::array<std::int64_t, 2>, std::size_t> curved_edge;
  for (std::size_t i = 0; 2 * i < part.curved_edges.size(); ++i) {
    const auto ends =
        std::minmax(part.vertex_input[part.curved_edges[2 * i]], part.vertex_input[part.curved_edges[2 * i + 1]]);
    curved_edge[{ends.first, ends.second}] = i;
  }
  std::vector<double> points(static_cast<std::size_t>(mesh.edges.num_local()) * d);
  std::int64_t num_curved = 0;
  for (std::int32_t edge = 0; edge < mesh.edges.num_local(); ++edge) {
    const std::int32_t a = mesh.edge_vertices[2 * edge], b = mesh.edge_vertices[2 * edge + 1];
    const auto ends = std::minmax(mesh.vertex_input[a], mesh.vertex_input[b]);
    const auto found = curved_edge.find({ends.first, ends.second});
    double* point = points.data() + static_cast<std::size_t>(edge) * d;
    if (found != curved_edge.end()) {
      std::copy_n(part.curved_points.begin() + found->second * d, d, point);
      ++num_curved;
    } else {
      for (int k = 0; k < d; ++k) point[k] = 0.5 * (mesh.point(a)[k] + mesh.point(b)[k]);
    }
  }
  if (base::sum(mesh.comm, num_curved) > 0) mesh.edge_points = std::move(points);
}

/// The named facets of the part, found among the facets of its cells.
void attach_named_facets(Mesh& mesh, const MeshPart& part) {
  const int d = mesh.dimension;
  std::map<std::array<std::int64_t, 3>, std::vector<std::int32_t>> groups_of_facet;
  for (std::size_t f = 0; f < part.facet_group.size(); ++f) {
    std::array<std::int64_t, 3> key = {-1, -1, -1};
    for (int i = 0; i < d; ++i) key[i] = part.vertex_input[part.facet_vertices[f * d + i]];
    std::sort(key.begin(), key.begin() + d);
    groups_of_facet[key].push_back(part.facet_group[f]);
  }
  if (groups_of_facet.empty()) return;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    for (int opposite = 0; opposite <= d; ++opposite) {
      std::array<std::int64_t, 3> key = {-1, -1, -1};
      for (int i = 0, n = 0; i <= d; ++i) {
        if (i != opposite) key[n++] = mesh.vertex_input[vertices[i]];
      }
      std::sort(key.begin(), key.begin() + d);
      const auto found = groups_of_facet.find(key);
      if (found == groups_of_facet.end()) continue;
      for (const std::int32_t group : found->second) mesh.named_facets.push_back({cell, opposite, group});
    }
  }
}

}  // namespace

std::span<const std::array<int, 2>> edges_of_cell(int dimension) {
  if (dimension == 2) return triangle_edges;
  return tetrahedron_edges;
}

int index_of(std::span<const std::string> names, const std::string& name) {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? -1 : static_cast<int>(found - names.begin());
}

Mesh build_mesh(MPI_Comm comm, const MeshPart& part) {
  assert(part.dimension == 2 || part.dimension == 3);
  Mesh mesh;
  mesh.comm = comm;
  mesh.dimension = part.dimension;
  mesh.region_names = part.region_names;
  mesh.group_names = part.group_names;
  mesh.cell_region = part.cell_region;
  mesh.cells = base::contiguous_index_map(comm, static_cast<std::int32_t>(part.cell_region.size()));
  number_vertices(mesh, part);
  number_edges(mesh);
  place_edge_points(mesh, part);
  connect_neighbours(mesh);
  attach_named_facets(mesh, part);
  return mesh;
}

}  // namespace vocalis::mesh
