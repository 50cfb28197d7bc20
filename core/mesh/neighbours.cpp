#include "core/mesh/neighbours.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <unordered_map>

#include "core/base/mpi.hpp"

namespace vocalis::mesh {

namespace {

struct OpenFacet {
  std::int64_t key;
  std::size_t position;  ///< in cell_neighbours
};

/// One 64-bit key a facet: the edge of its two lowest vertices times the number of vertices, plus the third vertex
/// (3-D), or just its edge (2-D).
std::int64_t facet_key(const Mesh& mesh, std::int32_t cell, int opposite) {
  const auto vertices = mesh.vertices_of(cell);
  const auto pairs = edges_of_cell(mesh.dimension);
  const std::int32_t* edges = mesh.cell_edges.data() + cell * pairs.size();
  std::array<std::pair<std::int64_t, int>, 3> corners;
  int count = 0;
  for (int i = 0; i <= mesh.dimension; ++i) {
    if (i != opposite) corners[count++] = {mesh.vertices.to_global(vertices[i]), i};
  }
  std::sort(corners.begin(), corners.begin() + count);
  for (std::size_t e = 0; e < pairs.size(); ++e) {
    const auto [a, b] = pairs[e];
    const int first = corners[0].second, second = corners[1].second;
    if ((a != first || b != second) && (a != second || b != first)) continue;
    const std::int64_t edge = mesh.edges.to_global(edges[e]);
    return mesh.dimension == 2 ? edge : edge * mesh.vertices.num_global + corners[2].first;
  }
  return -1;
}

/// Matches facets within this rank; what stays open is on the boundary or belongs to another rank's cell too.
std::vector<OpenFacet> match_on_this_rank(Mesh& mesh) {
  const int facets = mesh.dimension + 1;
  std::unordered_map<std::int64_t, std::size_t> waiting;
  mesh.cell_neighbours.assign(static_cast<std::size_t>(mesh.num_cells()) * facets, -1);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (int i = 0; i < facets; ++i) {
      const std::size_t here = static_cast<std::size_t>(cell) * facets + i;
      const auto [entry, is_new] = waiting.try_emplace(facet_key(mesh, cell, i), here);
      if (is_new) continue;
      mesh.cell_neighbours[here] = static_cast<std::int32_t>(entry->second / facets);
      mesh.cell_neighbours[entry->second] = cell;
      waiting.erase(entry);
    }
  }
  std::vector<OpenFacet> open;
  for (const auto& [key, position] : waiting) open.push_back({key, position});
  std::sort(open.begin(), open.end(), [](const auto& a, const auto& b) { return a.position < b.position; });
  return open;
}

/// For each open facet the global cell on another rank that has it too, and that rank; -1 at the boundary.
std::vector<std::array<std::int64_t, 2>> match_across_ranks(const Mesh& mesh, const std::vector<OpenFacet>& open) {
  const int ranks = base::size(mesh.comm);
  std::vector<std::vector<std::int64_t>> outgoing(ranks);
  for (const OpenFacet& facet : open) {
    auto& list = outgoing[facet.key % ranks];
    list.push_back(facet.key);
    list.push_back(mesh.cells.offset + static_cast<std::int64_t>(facet.position / (mesh.dimension + 1)));
  }
  const auto incoming = base::exchange(mesh.comm, outgoing);
  std::map<std::int64_t, std::vector<std::array<std::int64_t, 2>>> cells_of_key;
  for (int r = 0; r < ranks; ++r) {
    for (std::size_t i = 0; i < incoming[r].size(); i += 2)
      cells_of_key[incoming[r][i]].push_back({incoming[r][i + 1], r});
  }
  std::vector<std::vector<std::int64_t>> answers(ranks);
  for (int r = 0; r < ranks; ++r) {
    for (std::size_t i = 0; i < incoming[r].size(); i += 2) {
      std::array<std::int64_t, 2> other = {-1, -1};
      for (const auto& candidate : cells_of_key[incoming[r][i]]) {
        if (candidate[1] != r) other = candidate;
      }
      answers[r].insert(answers[r].end(), other.begin(), other.end());
    }
  }
  const auto replies = base::exchange(mesh.comm, answers);
  std::vector<std::size_t> next(ranks, 0);
  std::vector<std::array<std::int64_t, 2>> result;
  for (const OpenFacet& facet : open) {
    const std::size_t home = static_cast<std::size_t>(facet.key % ranks);
    result.push_back({replies[home][next[home]], replies[home][next[home] + 1]});
    next[home] += 2;
  }
  return result;
}

}  // namespace

void connect_neighbours(Mesh& mesh) {
  const std::vector<OpenFacet> open = match_on_this_rank(mesh);
  const auto others = match_across_ranks(mesh, open);
  std::map<std::int64_t, std::int32_t> ghost_of_global;
  for (std::size_t i = 0; i < open.size(); ++i) {
    if (others[i][0] < 0) continue;
    const auto [entry, is_new] = ghost_of_global.try_emplace(others[i][0], mesh.cells.num_local());
    if (is_new) {
      mesh.cells.ghost_global.push_back(others[i][0]);
      mesh.cells.ghost_owner.push_back(static_cast<int>(others[i][1]));
    }
    mesh.cell_neighbours[open[i].position] = entry->second;
  }
  mesh.cell_halo = base::Halo(mesh.cells);
  mesh.cell_region.resize(mesh.cells.num_local(), -1);
  mesh.cell_halo.copy_to_ghosts(mesh.cell_region);
}

}  // namespace vocalis::mesh
