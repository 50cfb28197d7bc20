#include "coupling/monitors/monitors.hpp"

#include <fmt/format.h>

#include <set>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/facet_integrals.hpp"
#include "coupling/monitors/line_flux.hpp"
#include "fsi_solver/continuum.hpp"
#include "fsi_solver/solution/assembly.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;

std::string words(const fem::Point& point, int dimension) {
  return dimension == 2 ? fmt::format("[{}, {}]", point[0], point[1])
                        : fmt::format("[{}, {}, {}]", point[0], point[1], point[2]);
}

/// Whether each local cell, ghosts too, is fluid.
std::vector<std::int32_t> mark_fluid(const fsi::Continuum& continuum) {
  const mesh::Mesh& mesh = *continuum.mesh;
  std::set<std::int32_t> solids;
  for (const fsi::SolidMaterial& solid : continuum.solids) {
    solids.insert(mesh::index_of(mesh.region_names, solid.region));
  }
  std::vector<std::int32_t> result;
  for (const std::int32_t region : mesh.cell_region) result.push_back(solids.count(region) == 0);
  return result;
}

/// Where the dofs of the velocity's space are now [m].
std::vector<double> moved_points(const fsi::FsiSolver& flow) {
  std::vector<double> result = flow.continuum().reference_points;
  const std::vector<double>& displacement = flow.state().displacement.values;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += displacement[i];
  return result;
}

}  // namespace

Monitors::Monitors(const fsi::FsiSolver& flow, const std::vector<MonitorSettings>& settings)
    : flow_(&flow), cell_is_fluid_(mark_fluid(flow.continuum())) {
  for (const MonitorSettings& monitor : settings) {
    for (const MonitorColumn& column : columns_of(monitor, flow.continuum().mesh->dimension)) {
      columns_.push_back(column.name());
    }
    monitors_.push_back(bind(monitor));
    if (monitor.kind == MonitorKind::energy) open_ = fsi::find_open_facets(flow);
  }
  std::set<std::string> seen;
  for (const std::string& column : columns_) {
    if (seen.insert(column).second) continue;
    throw UserError("every column of the monitors needs a name of its own", "\"" + column + "\" twice",
                    "rename one of the monitors, or leave it out");
  }
}

Monitors::Bound Monitors::bind(const MonitorSettings& monitor) const {
  Bound bound;
  bound.settings = monitor;
  switch (monitor.kind) {
    case MonitorKind::gap:
      find_facets(bound);
      break;
    case MonitorKind::glottis:
      bound.glottis = make_glottis(*flow_, monitor, cell_is_fluid_);
      break;
    case MonitorKind::flux:
      if (!monitor.group.empty()) {
        find_facets(bound);
      } else if (flow_->continuum().mesh->dimension != 2) {
        throw UserError("monitor \"" + monitor.name + "\": a line can be crossed in the plane only", "a mesh in space",
                        "name a group of facets instead");
      }
      break;
    case MonitorKind::displacement:
      bound.probe = find(monitor, monitor.position, false);
      break;
    case MonitorKind::pressure_difference:
      bound.other = find(monitor, monitor.other, true);
      [[fallthrough]];
    case MonitorKind::pressure:
      bound.probe = find(monitor, monitor.position, true);
      break;
    case MonitorKind::force:
      bound.body = fsi::make_body(*flow_, monitor.groups);
      break;
    case MonitorKind::energy:
      break;
  }
  return bound;
}

void Monitors::find_facets(Bound& bound) const {
  const mesh::Mesh& mesh = *flow_->continuum().mesh;
  bound.facets = fem::facets_seen_once(mesh, bound.settings.group);
  if (base::sum(mesh.comm, static_cast<std::int64_t>(bound.facets.size())) > 0) return;
  throw UserError("monitor \"" + bound.settings.name + "\" needs a group of facets on the flow mesh",
                  "\"" + bound.settings.group + "\", which has none there",
                  mesh::index_of(mesh.group_names, bound.settings.group) < 0
                      ? base::did_you_mean(bound.settings.group, mesh.group_names)
                      : "name a group that fluid or solid touches");
}

Probe Monitors::find(const MonitorSettings& monitor, const fem::Point& position, bool in_fluid) const {
  const fsi::Continuum& continuum = flow_->continuum();
  const std::vector<std::int32_t> everywhere(continuum.mesh->num_cells(), 1);
  const Probe probe =
      find_probe(flow_->velocity_space(), continuum.reference_points, position, in_fluid ? cell_is_fluid_ : everywhere);
  if (probe.rank >= 0) return probe;
  throw UserError(
      "monitor \"" + monitor.name + "\" needs a point inside " + (in_fluid ? "the fluid" : "the fluid or a solid"),
      words(position, continuum.mesh->dimension), "choose a point of the mesh before it moves [m]");
}

std::vector<double> Monitors::force(const Bound& monitor) const {
  const std::array<double, 3> force = fsi::force_on(*flow_, *monitor.body);
  std::vector<double> result(force.begin(), force.begin() + flow_->continuum().mesh->dimension);
  if (monitor.settings.reference_force > 0) {
    for (double& component : result) component /= monitor.settings.reference_force;
  }
  return result;
}

void Monitors::follow_step() {
  if (!open_) return;
  rates_ = fsi::energy(*flow_, *open_);
  balance_.advance(flow_->assembly().fields().stage(), rates_);
}

std::vector<double> Monitors::evaluate() const {
  const fsi::State& state = flow_->state();
  const fem::Space& space = flow_->velocity_space();
  const std::vector<double> points = moved_points(*flow_);
  std::vector<double> values;
  const auto append = [&](const std::vector<double>& more) { values.insert(values.end(), more.begin(), more.end()); };
  for (const Bound& monitor : monitors_) {
    const MonitorSettings& settings = monitor.settings;
    const double factor = settings.mirrored ? 2 : 1;
    switch (settings.kind) {
      case MonitorKind::gap:
        values.push_back(factor * fem::gap_to_plane(space, points, monitor.facets, settings.axis, settings.plane));
        break;
      case MonitorKind::glottis:
        append(glottis_values(*flow_, *monitor.glottis, points, cell_is_fluid_));
        break;
      case MonitorKind::flux:
        values.push_back(factor * (settings.group.empty()
                                       ? flux_across(state.velocity, points, settings.from, settings.to, cell_is_fluid_)
                                       : fem::flux_through(state.velocity, points, monitor.facets)));
        break;
      case MonitorKind::displacement:
        append(value_at(state.displacement, monitor.probe));
        break;
      case MonitorKind::pressure:
        append(value_at(state.pressure, monitor.probe));
        break;
      case MonitorKind::pressure_difference:
        values.push_back(value_at(state.pressure, monitor.probe)[0] - value_at(state.pressure, monitor.other)[0]);
        break;
      case MonitorKind::force:
        append(force(monitor));
        break;
      case MonitorKind::energy:
        append({rates_.kinetic, rates_.elastic, rates_.supplied, rates_.dissipated, balance_.left()});
        break;
    }
  }
  return values;
}

std::vector<const Glottis*> Monitors::glottises() const {
  std::vector<const Glottis*> result;
  for (const Bound& monitor : monitors_) {
    if (monitor.glottis) result.push_back(&*monitor.glottis);
  }
  return result;
}

GlottalOpening Monitors::opening(const Glottis& glottis) const {
  return measure_opening(*flow_, glottis, moved_points(*flow_));
}

}  // namespace vocalis::coupling
