#include "coupling/far_field/flow_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/flood.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

std::size_t place_of(const mesh::Mesh& mesh, std::int32_t cell, int facet) {
  return static_cast<std::size_t>(cell) * (mesh.dimension + 1) + facet;
}

double dot(const fem::Point& a, const fem::Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Whether each owned cell holds the vertex of the mesh that is farthest to the left: no surface is around that.
/// Collective.
std::vector<std::int32_t> cells_at_the_end(const mesh::Mesh& mesh) {
  double lowest = std::numeric_limits<double>::infinity();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) lowest = std::min(lowest, mesh.point(v)[0]);
  lowest = base::smallest(mesh.comm, lowest);
  std::vector<std::int32_t> result(mesh.num_cells(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t v : mesh.vertices_of(cell)) result[cell] |= mesh.point(v)[0] == lowest ? 1 : 0;
  }
  return result;
}

/// Whether each local cell is on the far side of facets inside the mesh. Throws UserError if they have no two sides.
/// Collective.
std::vector<std::int32_t> far_side(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets,
                                   const std::string& name) {
  std::vector<char> is_barred(mesh.cell_neighbours.size(), 0);
  for (const mesh::NamedFacet& facet : facets) is_barred[place_of(mesh, facet.cell, facet.index)] = 1;
  std::vector<std::int32_t> marks = mesh::flooded(mesh, cells_at_the_end(mesh), is_barred);
  std::int32_t leaks = 0;
  for (const mesh::NamedFacet& facet : facets) {
    const std::int32_t behind = mesh.cell_neighbours[place_of(mesh, facet.cell, facet.index)];
    if (marks[facet.cell] == marks[behind]) leaks = 1;
  }
  if (base::largest(mesh.comm, leaks) == 0) return marks;
  throw UserError(fmt::format("the surface of microphone '{}' parts the flow into an inside and an outside", name),
                  "both are on one side of a facet", "name all groups of a closed surface");
}

}  // namespace

FlowSurface::FlowSurface(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_is_fluid,
                         const FlowMaterial& material, const SurfaceMicrophoneSettings& settings)
    : mesh_(mesh), material_(material), settings_(settings) {
  std::vector<mesh::NamedFacet> walls, inside;
  for (const std::string& group : settings.groups) {
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, group)) {
      if (!cell_is_fluid[facet.cell]) continue;
      const std::int32_t behind = mesh.cell_neighbours[place_of(mesh, facet.cell, facet.index)];
      (behind >= 0 && cell_is_fluid[behind] ? inside : walls).push_back(facet);
    }
  }
  const auto all = [&mesh](const auto& facets) {
    return base::sum(mesh.comm, static_cast<std::int64_t>(facets.size()));
  };
  if (all(walls) + all(inside) == 0) {
    throw UserError(fmt::format("the surface of microphone '{}' has facets that the fluid touches", settings.name),
                    fmt::format("\"{}\" has none", fmt::join(settings.groups, "\", \"")),
                    "name walls of the flow, or a closed surface inside it");
  }
  if (all(inside) > 0 && settings.method == SurfaceMethod::curle) {
    throw UserError(fmt::format("microphone '{}' of kind \"curle\" hears solid walls", settings.name),
                    fmt::format("\"{}\" inside the fluid", fmt::join(settings.groups, "\", \"")),
                    "write kind = \"fwh\", or name walls");
  }
  for (const mesh::NamedFacet& facet : walls) take(facet, -1);
  if (all(inside) > 0) {
    const std::vector<std::int32_t> is_far = far_side(mesh, inside, settings.name);
    for (const mesh::NamedFacet& facet : inside) {
      if (!is_far[facet.cell]) take(facet, 1);
    }
  }
  longest_edge_ = base::largest(mesh.comm, longest_edge_);
}

void FlowSurface::take(const mesh::NamedFacet& facet, double sign) {
  facets_.push_back({facet.cell, facet.index, sign});
  const mesh::FacetGeometry geometry = mesh::facet_geometry(mesh_, facet.cell, facet.index);
  const auto corners = mesh::facet_vertices(mesh_, facet.cell, facet.index);
  const int d = mesh_.dimension;
  fem::Point middle = {0, 0, 0}, area = {0, 0, 0};
  for (int k = 0; k < d; ++k) {
    for (int i = 0; i < d; ++i) middle[k] += mesh_.point(corners[i])[k] / d;
    area[k] = sign * geometry.measure * geometry.normal[k];
  }
  middles_.push_back(middle);
  areas_.push_back(area);
  for (int i = 0; i < d; ++i) {
    fem::Point edge = {0, 0, 0};
    for (int k = 0; k < d; ++k) edge[k] = mesh_.point(corners[(i + 1) % d])[k] - mesh_.point(corners[i])[k];
    longest_edge_ = std::max(longest_edge_, std::sqrt(dot(edge, edge)));
  }
}

std::vector<Emission> FlowSurface::emissions(const FlowSnapshot& before, const FlowSnapshot& flow) const {
  std::vector<Emission> result;
  for (const Facet& facet : facets_) {
    result.push_back(mesh_.dimension == 2 ? emission<2>(facet, before, flow) : emission<3>(facet, before, flow));
  }
  return result;
}

template <int D>
Emission FlowSurface::emission(const Facet& facet, const FlowSnapshot& before, const FlowSnapshot& flow) const {
  const auto vertices = mesh_.vertices_of(facet.cell);
  std::array<std::array<double, D>, D + 1> points;
  std::array<const double*, D + 1> corners;
  for (int i = 0; i <= D; ++i) {
    for (int k = 0; k < D; ++k) points[i][k] = mesh_.point(vertices[i])[k] + flow.displacement[vertices[i] * D + k];
    corners[i] = points[i].data();
  }
  const auto geometry = fem::simplex_geometry<D>(corners);
  const auto velocity = [&](int i, int k) { return flow.velocity[static_cast<std::size_t>(vertices[i]) * D + k]; };
  const double dt = flow.time - before.time;
  const auto passing = [&](int i, int k) {
    const std::size_t place = static_cast<std::size_t>(vertices[i]) * D + k;
    return flow.velocity[place] - (flow.displacement[place] - before.displacement[place]) / dt;
  };
  std::array<double, D> area;
  for (int k = 0; k < D; ++k) area[k] = -facet.sign * D * geometry.measure * geometry.gradient[facet.index][k];

  Emission result;
  // Flow through the facet at its corners, and the sums that the facet's mass matrix (1 + δ_ij) / (D (D + 1)) needs.
  double flux = 0, flow_through = 0, pressure = 0;
  std::array<double, D> momentum{}, sum{};
  for (int i = 0; i <= D; ++i) {
    if (i == facet.index) continue;
    double here = 0;
    for (int k = 0; k < D; ++k) {
      here += passing(i, k) * area[k];
      flow_through += velocity(i, k) * area[k] / D;
    }
    flux += here;
    for (int k = 0; k < D; ++k) {
      momentum[k] += velocity(i, k) * here;
      sum[k] += velocity(i, k);
    }
    pressure += flow.pressure[vertices[i]] / D;
  }
  for (int k = 0; k < D; ++k) {
    result.force[k] = pressure * area[k] + material_.density * (momentum[k] + sum[k] * flux) / (D * (D + 1));
    if (!settings_.viscous_stress) continue;
    for (int i = 0; i <= D; ++i) {
      for (int j = 0; j < D; ++j) {
        const double stretching = velocity(i, k) * geometry.gradient[i][j] + velocity(i, j) * geometry.gradient[i][k];
        result.force[k] -= material_.viscosity * stretching * area[j];
      }
    }
  }
  if (settings_.method != SurfaceMethod::curle) result.mass_rate = material_.density * flow_through;
  return result;
}

}  // namespace vocalis::coupling
