#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/facets.hpp"
#include "core/mesh/mesh.hpp"
#include "coupling/monitors/monitor_settings.hpp"

namespace vocalis::coupling {

/// The state of the flow that monitors read; vertices of the flow mesh, ghosts current.
struct MonitoredFlow {
  std::span<const double> coordinates;  ///< (vertices, d) [m], moved
  std::span<const double> velocity;     ///< (vertices, d) [m/s]
};

/// Monitors bound to their mesh.
class Monitors {
 public:
  /// The mesh must outlive the monitors. Throws UserError for a group that the flow mesh does not have. Collective.
  Monitors(const mesh::Mesh& flow_mesh, const std::vector<MonitorSettings>& settings);

  /// Column names with units, "gap_m", "flow_m2_s", "tip_x_m".
  const std::vector<std::string>& columns() const { return columns_; }
  /// One value a column, the same on every rank. Collective.
  std::vector<double> evaluate(const MonitoredFlow& flow) const;

 private:
  struct Bound {
    MonitorSettings settings;
    std::vector<mesh::NamedFacet> facets;
    int rank = -1;  ///< that has the nearest vertex
    std::int32_t vertex = -1;
  };
  const mesh::Mesh* mesh_;
  std::vector<Bound> monitors_;
  std::vector<std::string> columns_;
};

}  // namespace vocalis::coupling
