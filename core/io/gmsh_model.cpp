#include "core/io/gmsh_model.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <array>
#include <cmath>
#include <unordered_map>

#include "core/base/error.hpp"

namespace vocalis::io {

namespace {

using base::UserError;

constexpr int triangle = 2, tetrahedron = 4, line = 1;

/// Elements of one dimension in one physical group.
struct Group {
  std::string name;
  std::vector<std::size_t> nodes;   ///< (elements, dimension + 1) Gmsh's node tags
};

int type_of_simplex(int dimension) { return dimension == 1 ? line : dimension == 2 ? triangle : tetrahedron; }

std::size_t num_elements(int dimension) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension);
  std::size_t count = 0;
  for (const auto& list : tags) count += list.size();
  return count;
}

std::vector<Group> groups_of_dimension(int dimension, const std::string& path) {
  gmsh::vectorpair pairs;
  gmsh::model::getPhysicalGroups(pairs, dimension);
  std::vector<Group> groups;
  for (const auto& [dim, tag] : pairs) {
    Group group;
    gmsh::model::getPhysicalName(dim, tag, group.name);
    if (group.name.empty()) group.name = std::to_string(tag);
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dim, tag, entities);
    for (const int entity : entities) {
      std::vector<int> types;
      std::vector<std::vector<std::size_t>> tags, nodes;
      gmsh::model::mesh::getElements(types, tags, nodes, dim, entity);
      for (std::size_t i = 0; i < types.size(); ++i) {
        if (types[i] != type_of_simplex(dim)) {
          throw UserError("the mesh " + path + " must consist of triangles or tetrahedra with straight edges",
                          fmt::format("Gmsh element type {} in the group \"{}\"", types[i], group.name),
                          "mesh it again with Mesh.ElementOrder = 1 and without recombination");
        }
        group.nodes.insert(group.nodes.end(), nodes[i].begin(), nodes[i].end());
      }
    }
    groups.push_back(std::move(group));
  }
  return groups;
}

/// Coordinates of all nodes by their tags.
std::unordered_map<std::size_t, std::array<double, 3>> all_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters, -1, -1, false, false);
  std::unordered_map<std::size_t, std::array<double, 3>> result;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    result[tags[i]] = {coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]};
  }
  return result;
}

int dimension_of_model(const std::string& path) {
  for (const int dimension : {3, 2}) {
    if (num_elements(dimension) > 0) return dimension;
  }
  throw UserError("the mesh " + path + " must have triangles or tetrahedra", "none",
                  "define surfaces (2-D) or volumes (3-D) in the geometry");
}

/// Adds the cells of all groups; vertices are numbered as the cells first use them.
void add_cells(const std::vector<Group>& groups, const std::string& path, mesh::WholeMesh& mesh,
               std::unordered_map<std::size_t, std::int64_t>& vertex_of_node) {
  const auto nodes = all_nodes();
  for (const Group& group : groups) {
    if (group.nodes.empty()) continue;
    for (const std::size_t node : group.nodes) {
      const auto [entry, is_new] = vertex_of_node.try_emplace(node, static_cast<std::int64_t>(vertex_of_node.size()));
      mesh.cell_vertices.push_back(entry->second);
      if (!is_new) continue;
      const auto found = nodes.find(node);
      if (found == nodes.end()) {
        throw UserError("every cell of the mesh " + path + " needs its nodes", fmt::format("node {} is missing", node),
                        "write the mesh again");
      }
      for (int k = 0; k < mesh.dimension; ++k) {
        if (!std::isfinite(found->second[k])) {
          throw UserError("coordinates of the mesh " + path + " must be finite numbers",
                          fmt::format("{} at node {}", found->second[k], node), "write the mesh again");
        }
        mesh.coordinates.push_back(found->second[k]);
      }
      if (mesh.dimension == 2 && found->second[2] != 0) {
        throw UserError("a two-dimensional mesh must lie in the plane z = 0: " + path,
                        fmt::format("z = {} at node {}", found->second[2], node), "move it there, or mesh volumes");
      }
    }
    const auto region = static_cast<std::int32_t>(mesh.region_names.size());
    mesh.region_names.push_back(group.name);
    mesh.cell_region.resize(mesh.cell_vertices.size() / (mesh.dimension + 1), region);
  }
}

void add_facets(const std::vector<Group>& groups, const std::unordered_map<std::size_t, std::int64_t>& vertex_of_node,
                mesh::WholeMesh& mesh) {
  for (const Group& group : groups) {
    const auto index = static_cast<std::int32_t>(mesh.group_names.size());
    mesh.group_names.push_back(group.name);
    for (std::size_t first = 0; first < group.nodes.size(); first += mesh.dimension) {
      bool is_used = true;
      for (int i = 0; i < mesh.dimension; ++i) is_used = is_used && vertex_of_node.contains(group.nodes[first + i]);
      if (!is_used) continue;
      for (int i = 0; i < mesh.dimension; ++i) mesh.facet_vertices.push_back(vertex_of_node.at(group.nodes[first + i]));
      mesh.facet_group.push_back(index);
    }
  }
}

double volume(const mesh::WholeMesh& mesh, std::int64_t cell, double& longest) {
  std::array<std::array<double, 3>, 3> e{};
  const std::int64_t* corners = mesh.cell_vertices.data() + cell * (mesh.dimension + 1);
  longest = 0;
  for (int i = 0; i < mesh.dimension; ++i) {
    double squared = 0;
    for (int k = 0; k < mesh.dimension; ++k) {
      e[i][k] = mesh.coordinates[corners[i + 1] * mesh.dimension + k] - mesh.coordinates[corners[0] * mesh.dimension + k];
      squared += e[i][k] * e[i][k];
    }
    longest = std::max(longest, std::sqrt(squared));
  }
  if (mesh.dimension == 2) return 0.5 * std::abs(e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return std::abs(e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
                  e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

void reject_flat_cells(const mesh::WholeMesh& mesh, const std::string& path) {
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double longest = 0;
    if (volume(mesh, cell, longest) > 1e-9 * std::pow(longest, mesh.dimension)) continue;
    const double* point = mesh.coordinates.data() + mesh.cell_vertices[cell * (mesh.dimension + 1)] * mesh.dimension;
    throw UserError("every cell of the mesh " + path + " needs a volume",
                    fmt::format("a flat cell at ({:.6g}, {:.6g})", point[0], point[1]),
                    "check the geometry there, or mesh it finer");
  }
}

}  // namespace

mesh::WholeMesh extract_model(const std::string& path) {
  mesh::WholeMesh mesh;
  mesh.dimension = dimension_of_model(path);
  std::unordered_map<std::size_t, std::int64_t> vertex_of_node;
  add_cells(groups_of_dimension(mesh.dimension, path), path, mesh, vertex_of_node);
  const std::size_t all = num_elements(mesh.dimension);
  if (static_cast<std::size_t>(mesh.num_cells()) != all) {
    throw UserError("every cell of the mesh " + path + " must belong to one named group of cells",
                    fmt::format("{} cells, {} in named groups", all, mesh.num_cells()),
                    mesh.dimension == 2 ? "name all surfaces by Physical Surface(\"...\"), each once"
                                        : "name all volumes by Physical Volume(\"...\"), each once");
  }
  add_facets(groups_of_dimension(mesh.dimension - 1, path), vertex_of_node, mesh);
  reject_flat_cells(mesh, path);
  return mesh;
}

}  // namespace vocalis::io
