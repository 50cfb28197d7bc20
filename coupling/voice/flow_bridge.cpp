#include "coupling/voice/flow_bridge.hpp"

#include <algorithm>

#include "core/mesh/facets.hpp"

namespace vocalis::coupling {

namespace {

std::vector<std::int32_t> vertices_of_fluid(const Scene& scene) {
  const mesh::Mesh& flow = scene.flow->mesh;
  const std::vector<std::int32_t> is_fluid = fluid_cells(scene);
  std::vector<std::int32_t> vertices;
  for (std::int32_t cell = 0; cell < flow.num_cells(); ++cell) {
    if (!is_fluid[cell]) continue;
    const auto corners = flow.vertices_of(cell);
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<double> points_of(const mesh::Mesh& mesh, const std::vector<std::int32_t>& vertices) {
  std::vector<double> points;
  for (const std::int32_t v : vertices) points.insert(points.end(), mesh.point(v), mesh.point(v) + mesh.dimension);
  return points;
}

std::vector<mesh::NamedFacet> facets_of_fluid(const Scene& scene, const std::vector<std::string>& groups) {
  const std::vector<std::int32_t> is_fluid = fluid_cells(scene);
  std::vector<mesh::NamedFacet> facets;
  for (const std::string& group : groups) {
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(scene.flow->mesh, group)) {
      if (is_fluid[facet.cell]) facets.push_back(facet);
    }
  }
  return facets;
}

}  // namespace

FlowBridge::FlowBridge(const Scene& scene, const mesh::Mesh& air, const std::vector<std::string>& ends,
                       const std::string& name)
    : flow_space_(fem::lagrange(scene.flow->mesh, 1)),
      fluid_vertices_(vertices_of_fluid(scene)),
      ends_(facets_of_fluid(scene, ends)),
      to_air_(air, points_of(scene.flow->mesh, fluid_vertices_)),
      to_flow_(scene.flow->mesh, air.coordinates, fluid_cells(scene)) {
  to_air_.require_all("all of the flow must lie inside of the mesh of [[acoustic]] \"" + name + "\"");
}

void FlowBridge::carry(const fem::Load& from, fem::Load& to) const {
  std::vector<double> at_points;
  for (const std::int32_t v : fluid_vertices_) {
    at_points.insert(at_points.end(), from.at(v), from.at(v) + from.components);
  }
  to_air_.restrict_to(at_points, to);
}

std::vector<double> FlowBridge::values(const std::vector<double>& of_flow_vertices, int components) const {
  fem::Field field(flow_space_, components);
  std::copy(of_flow_vertices.begin(), of_flow_vertices.end(), field.values.begin());
  std::vector<double> result(to_flow_.num_points() * components);
  to_flow_.evaluate(field, result);
  return result;
}

std::vector<std::int32_t> FlowBridge::cells_in_flow(const mesh::Mesh& air) const {
  const std::vector<std::int32_t> in_flow = to_flow_.is_held();
  std::vector<std::int32_t> result(air.num_cells());
  for (std::int32_t cell = 0; cell < air.num_cells(); ++cell) {
    const auto corners = air.vertices_of(cell);
    result[cell] = std::all_of(corners.begin(), corners.end(), [&](std::int32_t v) { return in_flow[v] != 0; });
  }
  return result;
}

std::optional<FlowView> FlowBridge::with_ends(const FlowView& flow) const {
  if (ends_.empty()) return {};
  FlowView result = flow;
  result.outlet.insert(result.outlet.end(), ends_.begin(), ends_.end());
  std::erase_if(result.walls, [&](const mesh::NamedFacet& wall) {
    return std::any_of(ends_.begin(), ends_.end(),
                       [&](const auto& end) { return end.cell == wall.cell && end.index == wall.index; });
  });
  return result;
}

}  // namespace vocalis::coupling
