#include "coupling/monitors/glottis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "coupling/monitors/line_flux.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/measures/contact_load.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

/// A fold at rest: the box of its surface and the mean of its facets' corners [m].
struct Extent {
  fem::Point low, high, mean;
};

Extent extent_of(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Extent extent = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}, {0, 0, 0}};
  for (const mesh::NamedFacet& facet : facets) {
    const auto vertices = mesh.vertices_of(facet.cell);
    for (int i = 0; i <= mesh.dimension; ++i) {
      if (i == facet.index) continue;
      for (int k = 0; k < mesh.dimension; ++k) {
        const double x = mesh.point(vertices[i])[k];
        extent.low[k] = std::min(extent.low[k], x);
        extent.high[k] = std::max(extent.high[k], x);
        extent.mean[k] += x;
      }
    }
  }
  const auto count = base::sum(mesh.comm, static_cast<std::int64_t>(facets.size())) * mesh.dimension;
  for (int k = 0; k < mesh.dimension; ++k) {
    extent.low[k] = base::smallest(mesh.comm, extent.low[k]);
    extent.high[k] = base::largest(mesh.comm, extent.high[k]);
    extent.mean[k] = base::sum(mesh.comm, extent.mean[k]) / static_cast<double>(count);
  }
  return extent;
}

std::vector<mesh::NamedFacet> facets_of_fold(const mesh::Mesh& mesh, const std::string& monitor,
                                             const std::string& group, const std::vector<std::int32_t>& cell_is_fluid) {
  std::vector<mesh::NamedFacet> facets = mesh::facets_of_group(mesh, group);
  std::erase_if(facets, [&](const mesh::NamedFacet& facet) { return !cell_is_fluid[facet.cell]; });
  if (base::sum(mesh.comm, static_cast<std::int64_t>(facets.size())) > 0) return facets;
  throw UserError("monitor \"" + monitor + "\" needs a group of facets that the fluid touches",
                  "\"" + group + "\", which has none there",
                  mesh::index_of(mesh.group_names, group) < 0 ? base::did_you_mean(group, mesh.group_names)
                                                              : "name the surface that the fold turns to the air");
}

/// Where both extents are, or the one.
Stations stations_over(const std::vector<Extent>& extents, int axis, int count, const std::string& monitor) {
  Stations stations = {axis, extents.front().low[axis], extents.front().high[axis], count};
  for (const Extent& extent : extents) {
    stations.begin = std::max(stations.begin, extent.low[axis]);
    stations.end = std::min(stations.end, extent.high[axis]);
  }
  if (stations.end > stations.begin) return stations;
  throw UserError(
      fmt::format("monitor \"{}\" needs folds that face each other over some length of {}", monitor, "xyz"[axis]),
      fmt::format("from {:.6g} m to {:.6g} m", stations.begin, stations.end),
      "name the two surfaces of one glottis, and the axes `axis` and `along` that fit them");
}

void check_axes(const MonitorSettings& settings, int dimension) {
  for (const auto& [key, axis] : {std::pair("axis", settings.axis), std::pair("along", settings.along)}) {
    if (axis < dimension) continue;
    throw UserError("monitor \"" + settings.name + "\": " + key + " must be an axis of the mesh", "\"z\" in the plane",
                    "choose \"x\" or \"y\"");
  }
  if (dimension == 2 || settings.depth == 0) return;
  throw UserError("monitor \"" + settings.name + "\": a depth [m] is for plane meshes",
                  fmt::format("{}", settings.depth), "leave it out: the mesh has the folds' length");
}

/// What lies between the folds over the grid.
struct Gap {
  std::vector<double> low, high;  ///< [m] its ends: a fold or the plane; infinite where no fold is
  std::vector<char> is_sealed;    ///< by contact cells, on all sides that have a fold
};

Gap find_gap(const fsi::FsiSolver& flow, const Glottis& glottis, std::span<const double> points) {
  const std::vector<double> plane(glottis.grid.size(), glottis.settings.plane);
  Gap gap = {plane, plane, std::vector<char>(plane.size(), 1)};
  for (const Glottis::Fold& fold : glottis.folds) {
    const FoldProfile profile =
        fold_profile(flow.velocity_space(), points, fold.facets, glottis.grid, fold.side, flow.state().in_contact);
    (fold.side > 0 ? gap.high : gap.low) = profile.nearest;
    for (std::size_t i = 0; i < plane.size(); ++i) gap.is_sealed[i] = gap.is_sealed[i] && profile.is_sealed[i];
  }
  return gap;
}

/// The station in the middle of the longest row of stations without any area.
int middle_of_seal(const std::vector<double>& areas) {
  int middle = 0, longest = 0, length = 0;
  for (int i = 0; i < static_cast<int>(areas.size()); ++i) {
    length = areas[i] == 0 ? length + 1 : 0;
    if (length <= longest) continue;
    longest = length;
    middle = i - length / 2;
  }
  return middle;
}

/// Velocity relative to the mesh, mean over the last step; before the first one both rest.
fem::Field relative_velocity(const fsi::State& state) {
  fem::Field result = state.velocity;
  if (state.last_dt == 0) return result;
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] = 0.5 * (state.velocity.values[i] + state.velocity_before.values[i]) -
                       (state.displacement.values[i] - state.displacement_before.values[i]) / state.last_dt;
  }
  return result;
}

/// The largest speed of the fluid at the dofs of its velocity [m/s]. Collective.
double largest_speed(const fsi::FsiSolver& flow) {
  const fsi::Continuum& continuum = flow.continuum();
  const fem::Field& velocity = flow.state().velocity;
  double largest = 0;
  for (std::int32_t dof = 0; dof < flow.velocity_space().num_dofs(); ++dof) {
    if (continuum.dof_solid[dof] != fsi::Continuum::fluid) continue;
    double square = 0;
    for (int k = 0; k < velocity.components; ++k) square += velocity.at(dof)[k] * velocity.at(dof)[k];
    largest = std::max(largest, square);
  }
  return std::sqrt(base::largest(continuum.mesh->comm, largest));
}

/// The largest pressure [Pa] that a contact cell on the surface of a fold bears across the glottis, as a mean over the
/// cell, at the stage of the last step. Collective.
double impact_stress(const fsi::FsiSolver& flow, const Glottis& glottis) {
  const mesh::Mesh& mesh = *flow.continuum().mesh;
  std::vector<double> normal(static_cast<std::size_t>(mesh.num_cells()) * mesh.dimension, 0.0);
  for (std::size_t i = glottis.grid.across; i < normal.size(); i += mesh.dimension) normal[i] = 1;
  const fsi::ContactLoad load = fsi::contact_load(flow, normal);
  double largest = 0;
  for (const Glottis::Fold& fold : glottis.folds) {
    for (const mesh::NamedFacet& facet : fold.facets) largest = std::max(largest, -load.normal_stress[facet.cell]);
  }
  return base::largest(mesh.comm, largest);
}

/// Contact cells of all ranks. Collective.
std::int64_t count_contact_cells(const fsi::FsiSolver& flow) {
  const std::vector<char>& marks = flow.state().in_contact;
  return base::sum(flow.continuum().mesh->comm, static_cast<std::int64_t>(std::count(marks.begin(), marks.end(), 1)));
}

}  // namespace

Glottis make_glottis(const fsi::FsiSolver& flow, const MonitorSettings& settings,
                     const std::vector<std::int32_t>& cell_is_fluid) {
  const mesh::Mesh& mesh = *flow.continuum().mesh;
  check_axes(settings, mesh.dimension);
  Glottis glottis;
  glottis.settings = settings;
  std::vector<Extent> extents;
  for (const std::string& group : {settings.group, settings.other_group}) {
    if (group.empty()) continue;
    glottis.folds.push_back({facets_of_fold(mesh, settings.name, group, cell_is_fluid), 1});
    extents.push_back(extent_of(mesh, glottis.folds.back().facets));
  }
  const double opposite = extents.size() > 1 ? extents[1].mean[settings.axis] : settings.plane;
  glottis.folds[0].side = extents[0].mean[settings.axis] >= opposite ? 1 : -1;
  if (glottis.folds.size() > 1) glottis.folds[1].side = -glottis.folds[0].side;
  const int third = 3 - settings.axis - settings.along;
  glottis.grid.across = settings.axis;
  glottis.grid.along = stations_over(extents, settings.along, settings.stations, settings.name);
  glottis.grid.span = {third, 0, 1, 1};
  if (mesh.dimension == 3) glottis.grid.span = stations_over(extents, third, settings.span_stations, settings.name);
  return glottis;
}

GlottalOpening measure_opening(const fsi::FsiSolver& flow, const Glottis& glottis, std::span<const double> points) {
  const FoldGrid& grid = glottis.grid;
  const double factor = glottis.settings.mirrored ? 2 : 1;
  const Gap gap = find_gap(flow, glottis, points);
  GlottalOpening opening;
  opening.area = opening.gap = std::numeric_limits<double>::infinity();
  const double span_step = grid.span.step();
  for (int i = 0; i < grid.along.count; ++i) {
    double& area = opening.areas.emplace_back(0);
    for (int j = 0; j < grid.span.count; ++j) {
      const std::size_t place = static_cast<std::size_t>(i) * grid.span.count + j;
      const double width = factor * std::max(0.0, gap.is_sealed[place] ? 0.0 : gap.high[place] - gap.low[place]);
      opening.gap = std::min(opening.gap, width);
      area += width * span_step;
    }
    if (std::isinf(area)) area = std::numeric_limits<double>::quiet_NaN();
    if (!(area < opening.area)) continue;
    opening.area = area;
    opening.narrowest = i;
  }
  if (opening.area == 0) opening.narrowest = middle_of_seal(opening.areas);
  const std::size_t narrowest = static_cast<std::size_t>(opening.narrowest) * grid.span.count;
  opening.low = gap.low[narrowest];
  opening.high = gap.high[narrowest];
  return opening;
}

double flow_past_folds(const fsi::FsiSolver& flow, const Glottis& glottis, const GlottalOpening& opening,
                       std::span<const double> points, const std::vector<std::int32_t>& cell_is_fluid) {
  const int along = glottis.grid.along.axis, across = glottis.grid.across;
  // A little into the folds, where nothing is fluid: their facets may be curved.
  const double into_fold = 0.05 * (opening.high - opening.low);
  bool has_low = false, has_high = false;
  for (const Glottis::Fold& fold : glottis.folds) (fold.side > 0 ? has_high : has_low) = true;
  fem::Point low = {0, 0, 0}, high = {0, 0, 0};
  low[along] = high[along] = glottis.grid.along.place(opening.narrowest);
  low[across] = opening.low - (has_low ? into_fold : 0);
  high[across] = opening.high + (has_high ? into_fold : 0);
  // To the right of the way from low to high is larger x, or smaller y.
  const double sign = (along == 0 ? 1 : -1) * (glottis.settings.mirrored ? 2 : 1);
  return sign * flux_across(relative_velocity(flow.state()), points, low, high, cell_is_fluid);
}

std::vector<double> glottis_values(const fsi::FsiSolver& flow, const Glottis& glottis, std::span<const double> points,
                                   const std::vector<std::int32_t>& cell_is_fluid) {
  const double depth = glottis.settings.depth;
  const bool is_plane = flow.continuum().mesh->dimension == 2;
  const GlottalOpening opening = measure_opening(flow, glottis, points);
  std::vector<double> values = {opening.gap};
  if (!is_plane || depth > 0) values.push_back(opening.area * (is_plane ? depth : 1));
  if (is_plane) {
    values.push_back(flow_past_folds(flow, glottis, opening, points, cell_is_fluid) * (depth > 0 ? depth : 1));
  }
  values.push_back(largest_speed(flow));
  const std::int64_t contact_cells = count_contact_cells(flow);
  values.push_back(contact_cells > 0 ? impact_stress(flow, glottis) : 0);
  values.push_back(static_cast<double>(contact_cells));
  return values;
}

}  // namespace vocalis::coupling
