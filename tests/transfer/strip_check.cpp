#include "tests/transfer/strip_check.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::transfer {

namespace {

/// A vertex is {number}, an edge or facet its sorted numbers, a cell {whole cell}.
using Name = std::vector<std::int64_t>;

Name sorted(Name name) {
  std::sort(name.begin(), name.end());
  return name;
}

/// A distributed kind of entity as the stripped mesh has it, with a name for each local one.
struct Kind {
  std::string what;
  const base::IndexMap& map;
  const base::Halo& halo;
  std::vector<Name> names;
  const std::vector<std::int32_t>& to_parent;
  const std::vector<std::int32_t>& from_parent;
};

/// Lowest rank with a kept cell at each entity, over the whole mesh.
std::map<Name, int> owners(const RandomCase& from, const std::vector<std::int32_t>& mask, bool edges) {
  std::map<Name, int> result;
  const int corners = from.whole.dimension + 1;
  for (std::int64_t cell = 0; cell < from.whole.num_cells(); ++cell) {
    if (!mask[cell]) continue;
    const std::int64_t* v = from.whole.cell_vertices.data() + cell * corners;
    for (int i = 0; i < corners; ++i) {
      for (int j = edges ? i + 1 : i; j < (edges ? corners : i + 1); ++j) {
        const Name name = edges ? sorted({v[i], v[j]}) : Name{v[i]};
        const auto [entry, is_new] = result.try_emplace(name, from.cell_rank[cell]);
        if (!is_new) entry->second = std::min(entry->second, from.cell_rank[cell]);
      }
    }
  }
  return result;
}

/// Checks owners, numbers, ghosts and the halo of one kind against the expected owner of each entity.
std::string check_kind(const Kind& kind, const std::map<Name, int>& owner) {
  const int here = base::rank(kind.map.comm);
  std::string wrong;
  const auto expect = [&](bool condition, const char* words) {
    if (!condition) wrong += kind.what + ": " + words + "\n";
  };
  const std::int32_t num_local = kind.map.num_local();
  expect(kind.names.size() == static_cast<std::size_t>(num_local), "as many names as local entities");
  expect(kind.map.num_global == static_cast<std::int64_t>(owner.size()), "every survivor is numbered once");
  const std::int64_t mine = std::count_if(owner.begin(), owner.end(), [&](const auto& o) { return o.second == here; });
  expect(kind.map.num_owned == mine, "owned entities");
  expect(kind.map.offset == base::contiguous_index_map(kind.map.comm, kind.map.num_owned).offset, "contiguous numbers");
  // The names of all owned entities in global order: a ghost must point at its own name.
  const std::size_t width = owner.empty() ? 1 : owner.begin()->first.size();
  std::vector<std::int64_t> flat;
  for (std::int32_t i = 0; i < kind.map.num_owned; ++i)
    flat.insert(flat.end(), kind.names[i].begin(), kind.names[i].end());
  const std::vector<std::int64_t> by_global = base::concatenate_all(kind.map.comm, flat);
  for (std::int32_t i = 0; i < num_local; ++i) {
    const auto expected = owner.find(kind.names[i]);
    expect(expected != owner.end(), "an entity that should be gone");
    if (expected == owner.end()) continue;
    const int found = i < kind.map.num_owned ? here : kind.map.ghost_owner[i - kind.map.num_owned];
    expect(found == expected->second, "owner is the lowest rank with a kept cell");
    const auto name = by_global.begin() + kind.map.to_global(i) * static_cast<std::int64_t>(width);
    expect(Name(name, name + static_cast<std::int64_t>(width)) == kind.names[i], "the global number names this entity");
    expect(i == 0 || i == kind.map.num_owned || kind.to_parent[i - 1] < kind.to_parent[i], "parent's order");
    expect(kind.from_parent[kind.to_parent[i]] == i, "maps are each other's inverse");
  }
  expect(std::set<Name>(kind.names.begin(), kind.names.end()).size() == kind.names.size(), "no entity twice");
  const auto survivors = std::count_if(kind.from_parent.begin(), kind.from_parent.end(), [](auto i) { return i >= 0; });
  expect(survivors == num_local, "nothing else in the map from the parent");
  for (std::size_t part = 0; part < width; ++part) {
    std::vector<std::int64_t> values(num_local, -1);
    for (std::int32_t i = 0; i < kind.map.num_owned; ++i) values[i] = kind.names[i][part];
    kind.halo.copy_to_ghosts(values);
    for (std::int32_t i = 0; i < num_local; ++i) expect(values[i] == kind.names[i][part], "halo");
  }
  return wrong;
}

/// The whole number of each local cell of the parent. Collective.
std::vector<std::int64_t> whole_cells(const RandomCase& from, const mesh::Mesh& parent) {
  std::vector<std::int64_t> result = from.cells_of_rank[base::rank(parent.comm)];
  result.resize(parent.cells.num_local(), -1);
  parent.cell_halo.copy_to_ghosts(result);
  return result;
}

struct Facets {
  std::map<Name, std::vector<std::int64_t>> kept_cells;  ///< of each facet
  std::map<Name, std::multiset<std::int32_t>> groups;
};

Facets facets_of(const RandomCase& from, const std::vector<std::int32_t>& mask) {
  Facets result;
  const int d = from.whole.dimension;
  for (std::int64_t cell = 0; cell < from.whole.num_cells(); ++cell) {
    if (!mask[cell]) continue;
    for (int opposite = 0; opposite <= d; ++opposite) {
      Name name;
      for (int i = 0; i <= d; ++i) {
        if (i != opposite) name.push_back(from.whole.cell_vertices[cell * (d + 1) + i]);
      }
      result.kept_cells[sorted(name)].push_back(cell);
    }
  }
  for (std::size_t f = 0; f < from.whole.facet_group.size(); ++f) {
    const auto first = from.whole.facet_vertices.begin() + static_cast<std::ptrdiff_t>(f) * d;
    result.groups[sorted(Name(first, first + d))].insert(from.whole.facet_group[f]);
  }
  return result;
}

std::string check_cells(const RandomCase& from, const std::vector<std::int32_t>& mask, const StrippedMesh& stripped,
                        const std::vector<Name>& cell_names) {
  std::string wrong;
  const auto expect = [&](bool condition, const char* words) {
    if (!condition) wrong += std::string("cells: ") + words + "\n";
  };
  const mesh::Mesh& mesh = stripped.mesh;
  const int d = mesh.dimension;
  const Facets facets = facets_of(from, mask);
  std::map<std::pair<std::int32_t, std::int32_t>, std::multiset<std::int32_t>> named;
  for (const auto& facet : mesh.named_facets) named[{facet.cell, facet.index}].insert(facet.group);
  std::set<std::int64_t> neighbours_elsewhere;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int64_t whole = cell_names[cell][0];
    Name corners, expected(from.whole.cell_vertices.begin() + whole * (d + 1),
                           from.whole.cell_vertices.begin() + (whole + 1) * (d + 1));
    for (const std::int32_t vertex : mesh.vertices_of(cell)) corners.push_back(mesh.vertex_input[vertex]);
    expect(sorted(corners) == sorted(expected), "corners");
    expect(mesh::signed_volume(mesh, mesh.vertices_of(cell)) > 0, "positive volume");
    const auto pairs = mesh::edges_of_cell(d);
    for (std::size_t e = 0; e < pairs.size(); ++e) {
      const std::int32_t* ends = mesh.edge_vertices.data() + 2 * mesh.cell_edges[cell * pairs.size() + e];
      expect(sorted({mesh.vertex_input[ends[0]], mesh.vertex_input[ends[1]]}) ==
                 sorted({corners[pairs[e][0]], corners[pairs[e][1]]}),
             "edges in their order");
    }
    for (int i = 0; i <= d; ++i) {
      Name facet = corners;
      facet.erase(facet.begin() + i);
      facet = sorted(facet);
      const auto& sides = facets.kept_cells.at(facet);
      const std::int64_t other = sides.size() < 2 ? -1 : (sides[0] == whole ? sides[1] : sides[0]);
      const std::int32_t found = mesh.cell_neighbours[static_cast<std::size_t>(cell) * (d + 1) + i];
      expect(found < 0 ? other < 0 : cell_names[found][0] == other, "neighbours");
      if (found >= mesh.num_cells()) neighbours_elsewhere.insert(found);
      const auto groups = facets.groups.find(facet);
      const auto found_groups = named.find({cell, i});
      expect((groups == facets.groups.end() ? std::multiset<std::int32_t>() : groups->second) ==
                 (found_groups == named.end() ? std::multiset<std::int32_t>() : found_groups->second),
             "facet groups");
    }
  }
  expect(neighbours_elsewhere.size() == static_cast<std::size_t>(mesh.cells.num_ghosts()), "ghosts are neighbours");
  for (std::int32_t cell = 0; cell < mesh.cells.num_local(); ++cell) {
    expect(mesh.cell_region[cell] == from.whole.cell_region[cell_names[cell][0]], "regions");
  }
  for (std::int32_t vertex = 0; vertex < mesh.num_vertices(); ++vertex) {
    const auto point = from.whole.coordinates.begin() + mesh.vertex_input[vertex] * d;
    expect(std::equal(point, point + d, mesh.point(vertex)), "coordinates");
  }
  return wrong;
}

std::string check_edge_points(const RandomCase& from, const mesh::Mesh& mesh, const std::vector<Name>& edge_names) {
  if (from.whole.curved_edges.empty()) return mesh.edge_points.empty() ? "" : "edge points of straight edges\n";
  const int d = mesh.dimension;
  std::vector<double> expected;
  for (const Name& ends : edge_names) {
    std::vector<double> point;
    for (int k = 0; k < d; ++k) {
      point.push_back(0.5 * (from.whole.coordinates[ends[0] * d + k] + from.whole.coordinates[ends[1] * d + k]));
    }
    for (std::size_t i = 0; 2 * i < from.whole.curved_edges.size(); ++i) {
      if (sorted({from.whole.curved_edges[2 * i], from.whole.curved_edges[2 * i + 1]}) != ends) continue;
      std::copy_n(from.whole.curved_points.begin() + static_cast<std::ptrdiff_t>(i) * d, d, point.begin());
    }
    expected.insert(expected.end(), point.begin(), point.end());
  }
  return mesh.edge_points == expected ? "" : "edge points\n";
}

}  // namespace

std::string check_strip(const RandomCase& from, const std::vector<std::int32_t>& mask, const mesh::Mesh& parent,
                        const StrippedMesh& stripped) {
  const mesh::Mesh& mesh = stripped.mesh;
  std::vector<Name> vertices, edges, cells;
  for (const std::int64_t number : mesh.vertex_input) vertices.push_back({number});
  for (std::size_t e = 0; e < mesh.edge_vertices.size(); e += 2) {
    edges.push_back(sorted({mesh.vertex_input[mesh.edge_vertices[e]], mesh.vertex_input[mesh.edge_vertices[e + 1]]}));
  }
  const std::vector<std::int64_t> whole = whole_cells(from, parent);
  for (const std::int32_t cell : stripped.cell_to_parent) cells.push_back({whole[cell]});
  std::map<Name, int> cell_owners;
  for (std::int64_t cell = 0; cell < from.whole.num_cells(); ++cell) {
    if (mask[cell]) cell_owners[{cell}] = from.cell_rank[cell];
  }
  const std::string wrong =
      check_kind(
          {"vertices", mesh.vertices, mesh.vertex_halo, vertices, stripped.vertex_to_parent, stripped.parent_to_vertex},
          owners(from, mask, false)) +
      check_kind({"edges", mesh.edges, mesh.edge_halo, edges, stripped.edge_to_parent, stripped.parent_to_edge},
                 owners(from, mask, true)) +
      check_kind({"cells", mesh.cells, mesh.cell_halo, cells, stripped.cell_to_parent, stripped.parent_to_cell},
                 cell_owners);
  return wrong + check_cells(from, mask, stripped, cells) + check_edge_points(from, mesh, edges);
}

}  // namespace vocalis::transfer
