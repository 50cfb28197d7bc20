#include "acoustic_solver/control_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/flood.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::acoustic {

namespace {

using base::UserError;

std::size_t place_of(const mesh::Mesh& mesh, std::int32_t cell, int facet) {
  return static_cast<std::size_t>(cell) * (mesh.dimension + 1) + facet;
}

/// The facets with the sources behind them, and whether each owned cell is on that side. Collective.
struct Sides {
  std::vector<mesh::NamedFacet> facets;
  std::vector<std::int32_t> is_inner;
};

Sides inner_side(const mesh::Mesh& mesh, const std::string& group, std::span<const std::int32_t> has_source) {
  const std::vector<mesh::NamedFacet> facets = mesh::facets_of_group(mesh, group);
  std::vector<char> is_barred(mesh.cell_neighbours.size(), 0);
  std::int32_t any_inside = 0;
  for (const mesh::NamedFacet& facet : facets) {
    is_barred[place_of(mesh, facet.cell, facet.index)] = 1;
    if (mesh.cell_neighbours[place_of(mesh, facet.cell, facet.index)] >= 0) any_inside = 1;
  }
  if (base::sum(mesh.comm, static_cast<std::int64_t>(facets.size())) == 0) {
    throw UserError("the surface of a far-field microphone has facets of the air", "\"" + group + "\" has none",
                    "choose a surface around the sources, in the air or at its end");
  }
  Sides sides;
  if (base::largest(mesh.comm, any_inside) == 0) {
    sides.facets = facets;
    sides.is_inner.assign(mesh.num_cells(), 1);
    return sides;
  }
  const std::vector<std::int32_t> marks = mesh::flooded(mesh, has_source, is_barred);
  std::int32_t leaks = 0;
  for (const mesh::NamedFacet& facet : facets) {
    const std::int32_t behind = mesh.cell_neighbours[place_of(mesh, facet.cell, facet.index)];
    if (behind >= 0 && marks[facet.cell] == marks[behind]) leaks = 1;
    if (marks[facet.cell]) sides.facets.push_back(facet);
  }
  if (base::largest(mesh.comm, leaks) > 0) {
    throw UserError("the surface of a far-field microphone parts the air with the sources from that without",
                    "\"" + group + "\" has both on one side of a facet",
                    "name all facets of a closed surface, or of one that ends at walls all around");
  }
  sides.is_inner.assign(marks.begin(), marks.begin() + mesh.num_cells());
  return sides;
}

void add_areas(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets,
               const std::vector<std::int32_t>& place, ControlSurface& surface) {
  for (const mesh::NamedFacet& facet : facets) {
    const mesh::FacetGeometry geometry = mesh::facet_geometry(mesh, facet.cell, facet.index);
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) surface.areas[place[corners[i]]][k] += geometry.measure * geometry.normal[k] / 3;
      const double *a = mesh.point(corners[i]), *b = mesh.point(corners[(i + 1) % 3]);
      surface.longest_edge = std::max(surface.longest_edge, std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]));
    }
  }
  surface.longest_edge = base::largest(mesh.comm, surface.longest_edge);
}

/// The sparse rows of the surface's vertices over the skin's cells.
void add_rows(const mesh::Mesh& mesh, const std::vector<std::int32_t>& cells, const std::vector<std::int32_t>& place,
              const std::vector<std::int32_t>& place_in_skin, ControlSurface& surface) {
  std::vector<std::map<std::int32_t, std::array<double, 2>>> rows(surface.points.size());
  for (const std::int32_t cell : cells) {
    const auto vertices = mesh.vertices_of(cell);
    const auto geometry = fem::simplex_geometry<3>(
        {mesh.point(vertices[0]), mesh.point(vertices[1]), mesh.point(vertices[2]), mesh.point(vertices[3])});
    for (int i = 0; i < 4; ++i) {
      if (place[vertices[i]] < 0) continue;
      for (int j = 0; j < 4; ++j) {
        auto& entry = rows[place[vertices[i]]][place_in_skin[vertices[j]]];
        for (int k = 0; k < 3; ++k) entry[0] += geometry.measure * geometry.gradient[i][k] * geometry.gradient[j][k];
        entry[1] += geometry.measure * (i == j ? 2 : 1) / 20;
      }
    }
  }
  surface.row_begin.push_back(0);
  for (const auto& row : rows) {
    for (const auto& [column, entry] : row) {
      surface.columns.push_back(column);
      surface.stiffness.push_back(entry[0]);
      surface.mass.push_back(entry[1]);
    }
    surface.row_begin.push_back(static_cast<std::int32_t>(surface.columns.size()));
  }
}

}  // namespace

ControlSurface control_surface(const mesh::Mesh& mesh, const std::string& group,
                               std::span<const std::int32_t> has_source) {
  if (mesh.dimension != 3) {
    throw UserError(
        "far-field microphones need a mesh of three dimensions", "a plane mesh",
        "place the microphone inside the air, with kind = \"mesh\": in the plane a wave never ends, and what "
        "passed the surface long ago still sounds");
  }
  if (mesh::index_of(mesh.group_names, group) < 0) {
    throw UserError("the surface of a far-field microphone is a group of facets of the mesh", group,
                    fmt::format("use one of: {}", fmt::join(mesh.group_names, ", ")));
  }
  const Sides sides = inner_side(mesh, group, has_source);
  const std::vector<std::int32_t> on_surface = mesh::mark_vertices(mesh, sides.facets);

  ControlSurface surface;
  std::vector<std::int32_t> cells, place(mesh.num_vertices(), -1), place_in_skin(mesh.num_vertices(), -1);
  std::int32_t sources = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    const bool touches = std::any_of(vertices.begin(), vertices.end(), [&](auto v) { return on_surface[v] != 0; });
    if (!touches || !sides.is_inner[cell]) continue;
    cells.push_back(cell);
    if (!has_source.empty() && has_source[cell]) sources = 1;
    for (const std::int32_t v : vertices) {
      if (place_in_skin[v] >= 0) continue;
      place_in_skin[v] = static_cast<std::int32_t>(surface.skin.size());
      surface.skin.push_back(v);
      if (!on_surface[v]) continue;
      place[v] = static_cast<std::int32_t>(surface.points.size());
      surface.vertex_in_skin.push_back(place_in_skin[v]);
      surface.points.push_back({mesh.point(v)[0], mesh.point(v)[1], mesh.point(v)[2]});
    }
  }
  if (base::largest(mesh.comm, sources) > 0) {
    throw UserError("no sound is made in the cells along the surface of a far-field microphone",
                    "\"" + group + "\" touches the flow or the source's group", "choose a surface further out");
  }
  surface.areas.assign(surface.points.size(), {0, 0, 0});
  add_areas(mesh, sides.facets, place, surface);
  add_rows(mesh, cells, place, place_in_skin, surface);
  return surface;
}

}  // namespace vocalis::acoustic
