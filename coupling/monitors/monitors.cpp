#include "coupling/monitors/monitors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::coupling {

namespace {

double gap(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets, const MonitorSettings& settings,
           std::span<const double> coordinates) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const mesh::NamedFacet& facet : facets) {
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    for (int i = 0; i < mesh.dimension; ++i) {
      const double coordinate = coordinates[corners[i] * mesh.dimension + settings.axis];
      smallest = std::min(smallest, std::abs(coordinate - settings.plane));
    }
  }
  return base::smallest(mesh.comm, smallest);
}

double flux(const mesh::Mesh& mesh, const std::vector<mesh::NamedFacet>& facets, std::span<const double> velocity) {
  double total = 0;
  for (const mesh::NamedFacet& facet : facets) {
    const auto geometry = mesh::facet_geometry(mesh, facet.cell, facet.index);
    const auto corners = mesh::facet_vertices(mesh, facet.cell, facet.index);
    for (int i = 0; i < mesh.dimension; ++i) {
      for (int k = 0; k < mesh.dimension; ++k) {
        total += geometry.measure / mesh.dimension * velocity[corners[i] * mesh.dimension + k] * geometry.normal[k];
      }
    }
  }
  return base::sum(mesh.comm, total);
}

/// The rank and its owned vertex nearest to a point. Collective.
std::pair<int, std::int32_t> nearest_vertex(const mesh::Mesh& mesh, const std::array<double, 3>& point) {
  double nearest = std::numeric_limits<double>::infinity();
  std::int32_t vertex = -1;
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    double squared = 0;
    for (int k = 0; k < mesh.dimension; ++k) squared += std::pow(mesh.point(v)[k] - point[k], 2);
    if (squared < nearest) nearest = squared, vertex = v;
  }
  const auto distances = base::gather_all(mesh.comm, nearest);
  return {static_cast<int>(std::min_element(distances.begin(), distances.end()) - distances.begin()), vertex};
}

}  // namespace

Monitors::Monitors(const mesh::Mesh& flow_mesh, const std::vector<MonitorSettings>& settings) : mesh_(&flow_mesh) {
  const int d = flow_mesh.dimension;
  for (const MonitorSettings& monitor : settings) {
    Bound bound = {monitor, {}, -1, -1};
    for (const MonitorColumn& column : columns_of(monitor, d)) columns_.push_back(column.name());
    if (monitor.kind == MonitorKind::displacement) {
      std::tie(bound.rank, bound.vertex) = nearest_vertex(flow_mesh, monitor.position);
    } else if (monitor.group.empty()) {
      throw base::UserError("monitor \"" + monitor.name + "\" is of a kind that is not computed yet", "such a monitor",
                            "leave it out");
    } else {
      bound.facets = mesh::facets_of_group(flow_mesh, monitor.group);
      if (base::sum(flow_mesh.comm, static_cast<std::int64_t>(bound.facets.size())) == 0) {
        throw base::UserError("monitor \"" + monitor.name + "\" needs a group of facets on the flow mesh",
                              "group = \"" + monitor.group + "\"",
                              base::did_you_mean(monitor.group, flow_mesh.group_names));
      }
    }
    monitors_.push_back(std::move(bound));
  }
}

std::vector<double> Monitors::evaluate(const MonitoredFlow& flow) const {
  std::vector<double> values;
  const int d = mesh_->dimension;
  for (const Bound& monitor : monitors_) {
    const double factor = monitor.settings.mirrored ? 2 : 1;
    switch (monitor.settings.kind) {
      case MonitorKind::gap:
        values.push_back(factor * gap(*mesh_, monitor.facets, monitor.settings, flow.coordinates));
        break;
      case MonitorKind::flux:
        values.push_back(factor * flux(*mesh_, monitor.facets, flow.velocity));
        break;
      case MonitorKind::force:
      case MonitorKind::pressure:
      case MonitorKind::pressure_difference:
      case MonitorKind::energy:
        break;
      case MonitorKind::displacement:
        for (int k = 0; k < d; ++k) {
          double value = 0;
          if (base::rank(mesh_->comm) == monitor.rank) {
            value = flow.coordinates[monitor.vertex * d + k] - mesh_->point(monitor.vertex)[k];
          }
          values.push_back(base::sum(mesh_->comm, value));
        }
        break;
    }
  }
  return values;
}

}  // namespace vocalis::coupling
