#include "acoustic_solver/boundaries.hpp"

#include <fmt/format.h>

#include "acoustic_solver/layer_profile.hpp"
#include "core/base/error.hpp"
#include "core/mesh/facets.hpp"

namespace vocalis::acoustic {

namespace {

void check(const mesh::Mesh& mesh, const AcousticSettings& settings, const AcousticBoundary& boundary) {
  if (mesh::index_of(mesh.group_names, boundary.group) < 0) {
    throw base::UserError(
        fmt::format("each boundary of acoustic solver '{}' names a group of facets of the mesh", settings.name),
        boundary.group, fmt::format("use one of: {}", fmt::join(mesh.group_names, ", ")));
  }
  if (boundary.admittance < 0) {
    throw base::UserError("a wall takes energy: its admittance is not negative", fmt::format("{}", boundary.admittance),
                          fmt::format("set admittance >= 0 on '{}'", boundary.group));
  }
  if (boundary.radius < 0) {
    throw base::UserError("the radius [m] of an open boundary is positive, or 0 for a plane",
                          fmt::format("{}", boundary.radius), fmt::format("set radius >= 0 on '{}'", boundary.group));
  }
}

BoundaryFacet condition(const AcousticSettings& settings, int dimension, const AcousticBoundary& boundary) {
  const double plane_wave = 1 / (settings.density * settings.speed_of_sound);
  BoundaryFacet facet;
  switch (boundary.kind) {
    case AcousticBoundaryKind::rigid:
    case AcousticBoundaryKind::yielding:
    case AcousticBoundaryKind::viscothermal:
      break;
    case AcousticBoundaryKind::admittance:
      facet.on_pressure = boundary.admittance * plane_wave;
      break;
    case AcousticBoundaryKind::open:
      facet.is_open = true;
      facet.on_pressure = plane_wave;
      if (boundary.radius > 0) facet.on_potential = 1 / (boundary.radius * (dimension == 2 ? 2 : 1));
      break;
    case AcousticBoundaryKind::pressure_release:
      facet.is_released = true;
      break;
    case AcousticBoundaryKind::flux:
      facet.is_flux = true;
      break;
  }
  return facet;
}

}  // namespace

std::vector<BoundaryFacet> boundary_conditions(const mesh::Mesh& mesh, const AcousticSettings& settings) {
  if (settings.wall_admittance < 0) {
    throw base::UserError("a wall takes energy: its admittance is not negative",
                          fmt::format("{}", settings.wall_admittance),
                          fmt::format("set wall_admittance >= 0 in acoustic solver '{}'", settings.name));
  }
  const int corners = mesh.dimension + 1;
  const auto count = static_cast<std::int32_t>(settings.boundaries.size());
  std::vector<std::int32_t> chosen(mesh.cell_neighbours.size(), count);
  for (std::int32_t b = count - 1; b >= 0; --b) {
    check(mesh, settings, settings.boundaries[b]);
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, settings.boundaries[b].group)) {
      chosen[static_cast<std::size_t>(facet.cell) * corners + facet.index] = b;
    }
  }
  AcousticBoundary wall;
  wall.kind = AcousticBoundaryKind::admittance;
  wall.admittance = settings.wall_admittance;
  AcousticBoundary behind_layer;
  behind_layer.kind = AcousticBoundaryKind::open;
  const auto sides = layer_sides(mesh, settings);
  std::vector<BoundaryFacet> conditions;
  for (const mesh::NamedFacet& facet : mesh::boundary_facets(mesh)) {
    const std::int32_t b = chosen[static_cast<std::size_t>(facet.cell) * corners + facet.index];
    const AcousticBoundary& unnamed = ends_a_layer(mesh, sides, facet) ? behind_layer : wall;
    BoundaryFacet here = condition(settings, mesh.dimension, b < count ? settings.boundaries[b] : unnamed);
    here.cell = facet.cell;
    here.index = facet.index;
    if (b < count && yields(settings.boundaries[b].kind)) here.wall = b;
    conditions.push_back(here);
  }
  return conditions;
}

}  // namespace vocalis::acoustic
