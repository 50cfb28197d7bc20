#pragma once

#include <array>
#include <functional>
#include <memory>

#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "coupling/scene.hpp"

namespace vocalis::coupling::test {

/// A box [0, size] (mesh::box) with the regions "fluid", "solid" and "air", each cell of the kind that a function gives
/// to its centre; whole as build_scene leaves it. Collective.
inline std::unique_ptr<Scene> box_scene(std::array<double, 3> size, std::array<int, 3> cells,
                                        const std::function<RegionKind(const std::array<double, 3>&)>& kind_at,
                                        MPI_Comm comm = MPI_COMM_WORLD) {
  mesh::WholeMesh whole = mesh::box(comm, size, cells);
  const int d = whole.dimension;
  whole.region_names = {"fluid", "solid", "air"};
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    std::array<double, 3> centre = {0, 0, 0};
    for (int a = 0; a <= d; ++a) {
      const std::int64_t vertex = whole.cell_vertices[cell * (d + 1) + a];
      for (int k = 0; k < d; ++k) centre[k] += whole.coordinates[vertex * d + k] / (d + 1);
    }
    whole.cell_region[cell] = static_cast<std::int32_t>(kind_at(centre));
  }
  auto scene = std::make_unique<Scene>();
  scene->parent = mesh::distribute(comm, whole);
  scene->kind_of_region = {RegionKind::fluid, RegionKind::solid, RegionKind::air};
  const auto strip = [&](RegionKind without) {
    std::vector<std::int32_t> keep(scene->parent.num_cells());
    for (std::int32_t cell = 0; cell < scene->parent.num_cells(); ++cell) {
      keep[cell] = scene->kind_of_region[scene->parent.cell_region[cell]] != without;
    }
    return std::make_unique<transfer::StrippedMesh>(transfer::strip(scene->parent, keep));
  };
  scene->flow = strip(RegionKind::air);
  scene->acoustic = strip(RegionKind::solid);
  return scene;
}

}  // namespace vocalis::coupling::test
