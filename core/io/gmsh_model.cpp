#include "core/io/gmsh_model.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "core/base/error.hpp"
#include "core/io/gmsh_curved_edges.hpp"

namespace vocalis::io {

namespace {

/// Elements of one dimension that belong to named groups.
struct Elements {
  std::vector<std::size_t> nodes;    ///< (elements, dimension + 1) tags of Gmsh
  std::vector<std::size_t> middles;  ///< (elements, 3 or 6) of cells, in the order of `edges_of_cell`; 0: none
  std::vector<std::int32_t> group;   ///< of each element
  std::vector<std::string> names;    ///< of the groups
};

int highest_dimension(const std::string& path) {
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  for (const int dimension : {3, 2}) {
    gmsh::model::mesh::getElements(types, tags, nodes, dimension);
    if (!types.empty()) return dimension;
  }
  throw base::UserError(path + ": a mesh needs triangles or tetrahedra", "no cells",
                        "give the geometry surfaces or volumes");
}

void refuse_type(const std::string& path, int type) {
  std::string name;
  int dimension = 0, order = 0, num_nodes = 0, num_corners = 0;
  std::vector<double> points;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, num_nodes, points, num_corners);
  throw base::UserError(
      path + ": cells must be triangles or tetrahedra of first or second order", name,
      num_corners == dimension + 1 ? "set Mesh.ElementOrder = 1 or 2" : "do not recombine (Recombine Surface, Layers)");
}

/// Adds the nodes of one second-order element: Gmsh lists the corners, then the middles of its edges.
void add_second_order(int dimension, const std::size_t* nodes, Elements& elements) {
  // A tetrahedron's last two edges are in the other order here.
  constexpr std::array<int, 3> of_triangle = {3, 4, 5};
  constexpr std::array<int, 6> of_tetrahedron = {4, 5, 6, 7, 9, 8};
  elements.nodes.insert(elements.nodes.end(), nodes, nodes + dimension + 1);
  if (dimension == 2) {
    for (const int middle : of_triangle) elements.middles.push_back(nodes[middle]);
  } else if (dimension == 3) {
    for (const int middle : of_tetrahedron) elements.middles.push_back(nodes[middle]);
  }
}

/// Adds an entity's elements to a group.
void add_entity(const std::string& path, int dimension, int entity, std::int32_t group, Elements& elements) {
  constexpr std::array<int, 4> first_order = {15, 1, 2, 4}, second_order = {15, 8, 9, 11}, num_nodes = {1, 3, 6, 10};
  std::vector<int> types;
  std::vector<std::vector<std::size_t>> tags, nodes;
  gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
  for (std::size_t t = 0; t < types.size(); ++t) {
    if (types[t] == first_order[dimension]) {
      elements.nodes.insert(elements.nodes.end(), nodes[t].begin(), nodes[t].end());
      if (dimension > 1) {
        elements.middles.resize(elements.middles.size() + tags[t].size() * mesh::edges_of_cell(dimension).size(), 0);
      }
    } else if (types[t] == second_order[dimension]) {
      for (std::size_t e = 0; e < tags[t].size(); ++e) {
        add_second_order(dimension, nodes[t].data() + e * num_nodes[dimension], elements);
      }
    } else {
      refuse_type(path, types[t]);
    }
    elements.group.insert(elements.group.end(), tags[t].size(), group);
  }
}

/// All elements of the groups of one dimension. An entity of several groups is listed once in each.
Elements grouped_elements(const std::string& path, int dimension) {
  Elements elements;
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  std::sort(groups.begin(), groups.end());
  for (const auto& [its_dimension, tag] : groups) {
    std::string name;
    gmsh::model::getPhysicalName(its_dimension, tag, name);
    if (name.empty()) {
      throw base::UserError(path + ": physical groups need names",
                            fmt::format("group {} of dimension {} has none", tag, dimension),
                            "write Physical Surface(\"name\") = {...}");
    }
    auto group = mesh::index_of(elements.names, name);
    if (group < 0) {
      group = static_cast<int>(elements.names.size());
      elements.names.push_back(name);
    }
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(dimension, tag, entities);
    std::sort(entities.begin(), entities.end());
    for (const int entity : entities) add_entity(path, dimension, entity, group, elements);
  }
  return elements;
}

/// Every entity with cells must be in exactly one region.
void check_regions(const std::string& path, int dimension) {
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  for (const auto& [its_dimension, entity] : entities) {
    std::vector<int> types, groups;
    std::vector<std::vector<std::size_t>> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    if (types.empty()) continue;
    gmsh::model::getPhysicalGroupsForEntity(dimension, entity, groups);
    if (groups.size() == 1) continue;
    const std::string kind = dimension == 2 ? "surface" : "volume";
    throw base::UserError(path + ": every cell must belong to one region, a named physical group",
                          fmt::format("the {} cells of {} {} belong to {}", tags[0].size(), kind, entity,
                                      groups.empty() ? "none" : fmt::format("{} regions", groups.size())),
                          fmt::format("add it to one Physical {}(\"name\")", dimension == 2 ? "Surface" : "Volume"));
  }
}

/// Numbers the vertices of the cells in the order of Gmsh's tags, and takes their coordinates.
std::unordered_map<std::size_t, std::int64_t> number_vertices(const std::string& path, const Elements& cells,
                                                              mesh::WholeMesh& mesh) {
  std::vector<std::size_t> used = cells.nodes;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  std::unordered_map<std::size_t, std::int64_t> number;
  for (const std::size_t tag : used) number.emplace(tag, static_cast<std::int64_t>(number.size()));

  std::vector<std::size_t> tags;
  std::vector<double> points, parameters;
  gmsh::model::mesh::getNodes(tags, points, parameters);
  const int d = mesh.dimension;
  mesh.coordinates.assign(used.size() * d, std::nan(""));
  double highest_z = 0, size = 0;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const auto found = number.find(tags[i]);
    if (found == number.end()) continue;
    std::copy_n(points.begin() + 3 * i, d, mesh.coordinates.begin() + found->second * d);
    highest_z = std::max(highest_z, std::abs(points[3 * i + 2]));
    size = std::max({size, std::abs(points[3 * i]), std::abs(points[3 * i + 1])});
  }
  const auto bad =
      std::find_if(mesh.coordinates.begin(), mesh.coordinates.end(), [](double x) { return !std::isfinite(x); });
  if (bad != mesh.coordinates.end()) {
    throw base::UserError(path + ": coordinates must be finite numbers",
                          fmt::format("{} at node {}", *bad, used[(bad - mesh.coordinates.begin()) / d]),
                          "correct the mesh file, or the geometry's formulas");
  }
  if (d == 2 && !(highest_z <= 1e-9 * size)) {
    throw base::UserError(path + ": a two-dimensional mesh must lie in the plane z = 0",
                          fmt::format("|z| up to {} m", highest_z), "draw it in the x-y plane, or add volumes");
  }
  return number;
}

/// The edges of the second-order cells, one that cells share once for each of them.
std::vector<EdgeMiddle> edge_middles(int dimension, const Elements& cells,
                                     const std::unordered_map<std::size_t, std::int64_t>& number) {
  const auto pairs = mesh::edges_of_cell(dimension);
  std::vector<EdgeMiddle> result;
  for (std::size_t i = 0; i < cells.middles.size(); ++i) {
    if (cells.middles[i] == 0) continue;
    const std::size_t* corners = cells.nodes.data() + i / pairs.size() * (dimension + 1);
    const auto& [a, b] = pairs[i % pairs.size()];
    result.push_back({number.at(corners[a]), number.at(corners[b]), cells.middles[i]});
  }
  return result;
}

double signed_measure(const mesh::WholeMesh& mesh, const std::int64_t* vertices, double& longest_edge) {
  const int d = mesh.dimension;
  std::array<std::array<double, 3>, 3> e{};
  longest_edge = 0;
  for (int i = 0; i < d; ++i) {
    double square = 0;
    for (int k = 0; k < d; ++k) {
      e[i][k] = mesh.coordinates[vertices[i + 1] * d + k] - mesh.coordinates[vertices[0] * d + k];
      square += e[i][k] * e[i][k];
    }
    longest_edge = std::max(longest_edge, std::sqrt(square));
  }
  if (d == 2) return 0.5 * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

/// Turns cells to positive volume; one without volume is an error.
void orient_cells(const std::string& path, mesh::WholeMesh& mesh) {
  const int d = mesh.dimension;
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    std::int64_t* vertices = mesh.cell_vertices.data() + cell * (d + 1);
    double longest_edge = 0;
    const double measure = signed_measure(mesh, vertices, longest_edge);
    if (measure < 0) std::swap(vertices[d - 1], vertices[d]);
    if (std::abs(measure) > 1e-12 * std::pow(longest_edge, d)) continue;
    const double* at = mesh.coordinates.data() + vertices[0] * d;
    throw base::UserError(path + ": cells must have a volume",
                          fmt::format("{} m{} in a cell of region \"{}\" near ({})", measure, d == 2 ? "^2" : "^3",
                                      mesh.region_names[mesh.cell_region[cell]], fmt::join(at, at + d, ", ")),
                          "look for lines or surfaces that touch or overlap there");
  }
}

}  // namespace

mesh::WholeMesh extract_model(const std::string& path, bool curved) {
  mesh::WholeMesh mesh;
  mesh.dimension = highest_dimension(path);
  Elements cells = grouped_elements(path, mesh.dimension);
  check_regions(path, mesh.dimension);
  Elements facets = grouped_elements(path, mesh.dimension - 1);
  const auto number = number_vertices(path, cells, mesh);
  for (const std::size_t tag : cells.nodes) mesh.cell_vertices.push_back(number.at(tag));
  mesh.cell_region = std::move(cells.group);
  mesh.region_names = std::move(cells.names);
  orient_cells(path, mesh);
  if (curved) add_curved_edges(path, edge_middles(mesh.dimension, cells, number), mesh);

  const int d = mesh.dimension;
  for (std::size_t f = 0; f < facets.group.size(); ++f) {
    const auto first = facets.nodes.begin() + static_cast<std::ptrdiff_t>(f) * d;
    if (!std::all_of(first, first + d, [&](std::size_t tag) { return number.contains(tag); })) continue;
    for (int i = 0; i < d; ++i) mesh.facet_vertices.push_back(number.at(first[i]));
    mesh.facet_group.push_back(facets.group[f]);
  }
  mesh.group_names = std::move(facets.names);
  return mesh;
}

}  // namespace vocalis::io
