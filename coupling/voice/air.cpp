#include "coupling/voice/air.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"
#include "coupling/voice/own_mesh.hpp"

namespace vocalis::coupling {

namespace {

/// The scene's acoustic mesh without those cells. Collective.
std::unique_ptr<transfer::StrippedMesh> strip_contact(const Scene& scene, std::span<const char> in_contact) {
  std::vector<std::int32_t> keep(scene.parent.num_cells());
  for (std::int32_t cell = 0; cell < scene.parent.num_cells(); ++cell) {
    const std::int32_t in_flow = scene.flow->parent_to_cell[cell];
    keep[cell] = scene.acoustic->parent_to_cell[cell] >= 0 && (in_flow < 0 || !in_contact[in_flow]);
  }
  return std::make_unique<transfer::StrippedMesh>(transfer::strip(scene.parent, keep));
}

}  // namespace

std::unique_ptr<Air> make_air(Scene& scene, std::span<const char> in_contact) {
  auto air = std::make_unique<Air>();
  const auto any =
      static_cast<std::int32_t>(std::any_of(in_contact.begin(), in_contact.end(), [](char c) { return c; }));
  if (base::largest(scene.parent.comm, any) > 0) air->own = strip_contact(scene, in_contact);
  air->stripped = air->own ? air->own.get() : scene.acoustic.get();
  const mesh::Mesh& mesh = air->mesh();
  const std::size_t d = mesh.dimension;
  air->rest_coordinates.resize(mesh.coordinates.size());
  for (std::size_t v = 0; v < air->stripped->vertex_to_parent.size(); ++v) {
    std::copy_n(scene.parent.point(air->stripped->vertex_to_parent[v]), d, air->rest_coordinates.begin() + v * d);
  }
  air->cell_has_flow.assign(mesh.num_cells(), 0);
  if (!scene.flow) return air;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    air->cell_has_flow[cell] = scene.kind_of_region[mesh.cell_region[cell]] == RegionKind::fluid;
  }
  air->from_flow = std::make_unique<transfer::SharedVertices>(
      transfer::SharedVertices::between(scene.parent, *scene.flow, *air->stripped));
  return air;
}

std::unique_ptr<Air> make_air(Scene& scene, const Case& config, const std::string& name) {
  const auto own = config.acoustic_meshes.find(name);
  if (own == config.acoustic_meshes.end()) return make_air(scene, {});
  auto air = std::make_unique<Air>();
  air->is_separate = true;
  air->own = std::make_unique<transfer::StrippedMesh>();
  air->own->mesh = make_own_mesh(scene.parent.comm, config, name, scene.parent.dimension);
  air->stripped = air->own.get();
  air->rest_coordinates = air->mesh().coordinates;
  air->cell_has_flow.assign(air->mesh().num_cells(), 0);
  if (!scene.flow) return air;
  air->follows = own->second.follows_flow;
  air->bridge = std::make_unique<FlowBridge>(scene, air->mesh(), own->second.flow_ends, name);
  air->cell_has_flow = air->bridge->cells_in_flow(air->mesh());
  return air;
}

void carry(const Air& air, const fem::Load& from, fem::Load& to) {
  if (air.bridge) {
    air.bridge->carry(from, to);
  } else {
    air.from_flow->carry(from, to);
  }
}

std::vector<double> values_of_flow(const Scene& scene, const Air& air, const std::vector<double>& of_flow_vertices,
                                   int components) {
  if (air.bridge) return air.bridge->values(of_flow_vertices, components);
  // A fluid cell is on the same rank in both meshes, so its vertices are, too.
  std::vector<double> result(static_cast<std::size_t>(air.mesh().num_vertices()) * components, 0.0);
  if (of_flow_vertices.empty()) return result;
  for (std::int32_t v = 0; v < air.mesh().num_vertices(); ++v) {
    const std::int32_t there = scene.flow->parent_to_vertex[air.stripped->vertex_to_parent[v]];
    if (there < 0) continue;
    for (int k = 0; k < components; ++k) result[v * components + k] = of_flow_vertices[there * components + k];
  }
  return result;
}

std::vector<double> moved_coordinates(const Air& air, const fem::Space& space, const fem::Field& displacement) {
  if (air.is_separate && !air.follows) return air.rest_coordinates;
  if (air.is_separate) {
    std::vector<double> coordinates = air.bridge->values(displacement.values, displacement.components);
    for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] += air.rest_coordinates[i];
    return coordinates;
  }
  fem::Field here(space, displacement.components);
  air.from_flow->carry(displacement, here);
  for (std::size_t i = 0; i < here.values.size(); ++i) here.values[i] += air.rest_coordinates[i];
  return std::move(here.values);
}

bool keeps_its_cells(const Air& air, std::span<const double> coordinates) {
  if (!air.follows) return true;
  const mesh::Mesh& mesh = air.mesh();
  std::int32_t turned_over = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (mesh::quality(mesh, cell, coordinates) <= 0) turned_over = 1;
  }
  return base::largest(mesh.comm, turned_over) == 0;
}

std::vector<std::int32_t> vertices_there(const Air& before, const Air& after) {
  std::vector<std::int32_t> there;
  for (const std::int32_t v : before.stripped->vertex_to_parent) there.push_back(after.stripped->parent_to_vertex[v]);
  return there;
}

}  // namespace vocalis::coupling
