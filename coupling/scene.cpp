#include "coupling/scene.hpp"

#include <optional>

#include "core/base/mpi.hpp"
#include "core/io/gmsh_reader.hpp"
#include "core/mesh/partition.hpp"
#include "coupling/balance.hpp"

namespace vocalis::coupling {

namespace {

std::unique_ptr<transfer::StrippedMesh> strip_by_kind(const Scene& scene, bool (*keeps)(RegionKind)) {
  std::vector<std::int32_t> keep(scene.parent.num_cells());
  for (std::int32_t cell = 0; cell < scene.parent.num_cells(); ++cell) {
    keep[cell] = keeps(scene.kind_of_region[scene.parent.cell_region[cell]]);
  }
  return std::make_unique<transfer::StrippedMesh>(transfer::strip(scene.parent, keep));
}

}  // namespace

std::unique_ptr<Scene> build_scene(MPI_Comm comm, const Case& config) {
  const MeshSettings& source = config.mesh;
  const bool curved = config.flow && config.flow->elements == fsi::Elements::p2p1;
  const mesh::WholeMesh whole = source.is_geometry ? io::mesh_geometry(comm, source.file, source.parameters, curved)
                                                   : io::read_mesh(comm, source.file, curved);
  check_case_against_mesh_names(config, whole.dimension, whole.region_names, whole.group_names);
  auto scene = std::make_unique<Scene>();
  const bool flow = config.has_flow();
  const bool acoustic = !config.acoustics.empty() && (!flow || sounds_on_the_case_mesh(config));
  std::vector<std::int32_t> cell_rank;
  if (base::rank(comm) == 0) {
    const auto kinds = kinds_of_regions(config, whole.region_names);
    const CellWork work = work_of_cells(whole, kinds, flow, acoustic);
    cell_rank = mesh::partition_cells(whole, base::size(comm), work.units, work.solvers);
  }
  scene->parent = mesh::build_mesh(comm, mesh::scatter(comm, whole, cell_rank));
  scene->kind_of_region = kinds_of_regions(config, scene->parent.region_names);
  if (flow) scene->flow = strip_by_kind(*scene, carries_flow);
  if (acoustic) scene->acoustic = strip_by_kind(*scene, carries_sound);
  return scene;
}

namespace {

/// Facets of fluid cells of the flow mesh for which `wanted(kind behind, if any)` holds.
template <class Wanted>
std::vector<mesh::NamedFacet> facets_of_fluid(const Scene& scene, const Wanted& wanted) {
  const transfer::StrippedMesh& flow = *scene.flow;
  const int facets = scene.parent.dimension + 1;
  const auto kind_of = [&](std::int32_t cell) { return scene.kind_of_region[scene.parent.cell_region[cell]]; };
  std::vector<mesh::NamedFacet> result;
  for (std::int32_t cell = 0; cell < flow.mesh.num_cells(); ++cell) {
    const std::int32_t parent_cell = flow.cell_to_parent[cell];
    if (kind_of(parent_cell) != RegionKind::fluid) continue;
    for (int i = 0; i < facets; ++i) {
      // Stripping keeps the order of a cell's vertices, so facet i is the same one in both meshes.
      const std::int32_t behind = scene.parent.cell_neighbours[static_cast<std::size_t>(parent_cell) * facets + i];
      if (wanted(behind < 0 ? std::optional<RegionKind>() : kind_of(behind))) result.push_back({cell, i, -1});
    }
  }
  return result;
}

}  // namespace

std::vector<mesh::NamedFacet> flow_outlet(const Scene& scene) {
  return facets_of_fluid(scene, [](std::optional<RegionKind> behind) { return behind == RegionKind::air; });
}

std::vector<mesh::NamedFacet> flow_walls(const Scene& scene) {
  return facets_of_fluid(scene,
                         [](std::optional<RegionKind> behind) { return !behind || *behind == RegionKind::solid; });
}

std::vector<std::int32_t> fluid_cells(const Scene& scene) {
  const mesh::Mesh& flow = scene.flow->mesh;
  std::vector<std::int32_t> result(flow.num_cells());
  for (std::int32_t cell = 0; cell < flow.num_cells(); ++cell) {
    result[cell] = scene.kind_of_region[flow.cell_region[cell]] == RegionKind::fluid;
  }
  return result;
}

}  // namespace vocalis::coupling
