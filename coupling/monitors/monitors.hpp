#pragma once

#include <string>
#include <vector>

#include "coupling/monitors/monitor_settings.hpp"
#include "coupling/monitors/probe.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::coupling {

/// Monitors bound to the flow that they watch.
class Monitors {
 public:
  /// The solver must outlive the monitors. Throws UserError for a group that the flow mesh does not have, a point
  /// outside it, a line in space, and columns of the same name. Collective.
  Monitors(const fsi::FsiSolver& flow, const std::vector<MonitorSettings>& settings);

  /// Column names with units, "gap_m", "flow_m2_s", "tip_x_m".
  const std::vector<std::string>& columns() const { return columns_; }
  /// One value a column from the flow's accepted state, the same on every rank. Collective.
  std::vector<double> evaluate() const;

 private:
  struct Bound {
    MonitorSettings settings;
    std::vector<mesh::NamedFacet> facets;  ///< of gap and flux
    Probe probe, other;                    ///< of displacement and pressures
  };
  Bound bind(const MonitorSettings& monitor) const;
  void find_facets(Bound& bound) const;
  Probe find(const MonitorSettings& monitor, const Point& position, bool in_fluid) const;

  const fsi::FsiSolver* flow_;
  std::vector<std::int32_t> cell_is_fluid_;  ///< of local cells, ghosts too
  std::vector<Bound> monitors_;
  std::vector<std::string> columns_;
};

}  // namespace vocalis::coupling
