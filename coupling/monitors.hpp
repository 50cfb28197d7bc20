#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "core/mesh/facets.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::coupling {

enum class MonitorKind {
  gap,          ///< smallest distance of a group's vertices from the plane where a coordinate has a given value [m]
  flux,         ///< volume flow out of the flow mesh through a group, ∫ v·n ds [m^2/s in 2-D, m^3/s]
  displacement  ///< displacement of the vertex nearest to a point, one column a component [m]
};

/// A number of the flow that history.csv records at every step.
struct MonitorSettings {
  std::string name;
  MonitorKind kind = MonitorKind::gap;
  std::string group;                           ///< of facets, for gap and flux
  int axis = 1;                                ///< 0, 1, 2 = x, y, z: normal of the plane, for gap
  double plane = 0;                            ///< its coordinate [m], for gap
  bool mirrored = false;                       ///< half model: gap and flux count twice
  std::array<double, 3> position = {0, 0, 0};  ///< [m], for displacement
};

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
