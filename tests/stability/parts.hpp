#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::fsi::test {

/// Regions and groups of a plane box by where the centres of its cells and of its boundary's facets are.
struct Parts {
  std::vector<std::string> regions;
  std::function<int(const std::array<double, 2>&)> region_at;  ///< -1: a hole
  std::vector<std::string> groups;
  std::function<int(const std::array<double, 2>&)> group_at;  ///< -1: none; asked around holes too
};

inline mesh::Mesh box_of_parts(std::array<double, 2> size, std::array<int, 2> cells, const Parts& parts) {
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {size[0], size[1], 0}, {cells[0], cells[1], 0});
  whole.region_names = parts.regions;
  whole.group_names = parts.groups;
  whole.facet_vertices.clear();
  whole.facet_group.clear();
  const auto centre_of = [&](const std::int64_t* vertices, int count) {
    std::array<double, 2> centre = {0, 0};
    for (int a = 0; a < count; ++a) {
      for (int k = 0; k < 2; ++k) centre[k] += whole.coordinates[2 * vertices[a] + k] / count;
    }
    return centre;
  };
  std::vector<std::int64_t> kept;
  std::map<std::array<std::int64_t, 2>, int> seen;
  whole.cell_region.clear();
  for (std::size_t first = 0; first < whole.cell_vertices.size(); first += 3) {
    const std::int64_t* v = whole.cell_vertices.data() + first;
    const int region = parts.region_at(centre_of(v, 3));
    if (region < 0) continue;
    kept.insert(kept.end(), v, v + 3);
    whole.cell_region.push_back(region);
    for (int a = 0; a < 3; ++a) {
      const auto [low, high] = std::minmax(v[a], v[(a + 1) % 3]);
      ++seen[{low, high}];
    }
  }
  whole.cell_vertices = kept;
  for (const auto& [edge, count] : seen) {
    const int group = count == 1 ? parts.group_at(centre_of(edge.data(), 2)) : -1;
    if (group < 0) continue;
    whole.facet_vertices.insert(whole.facet_vertices.end(), edge.begin(), edge.end());
    whole.facet_group.push_back(group);
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

}  // namespace vocalis::fsi::test
