#include "coupling/monitors/monitor_settings.hpp"

namespace vocalis::coupling {

std::vector<MonitorColumn> columns_of(const MonitorSettings& monitor, int dimension) {
  const std::string prefix = monitor.name.empty() ? "" : monitor.name + "_";
  std::vector<MonitorColumn> columns;
  switch (monitor.kind) {
    case MonitorKind::gap:
      return {{monitor.name, "_m"}};
    case MonitorKind::flux:
      return {{monitor.name, dimension == 2 ? "_m2_s" : "_m3_s"}};
    case MonitorKind::pressure:
    case MonitorKind::pressure_difference:
      return {{monitor.name, "_Pa"}};
    case MonitorKind::displacement:
      columns = {{prefix + "x", "_m"}, {prefix + "y", "_m"}, {prefix + "z", "_m"}};
      break;
    case MonitorKind::force:
      for (const char* component : {"drag", "lift", "side"}) {
        const bool is_coefficient = monitor.reference_force > 0;
        columns.push_back({prefix + component + (is_coefficient ? "_coefficient" : ""), is_coefficient ? "" : "_N"});
      }
      break;
    case MonitorKind::energy:
      return {{"energy_kinetic", "_J"},
              {"energy_elastic", "_J"},
              {"power_supplied", "_W"},
              {"power_dissipated", "_W"},
              {"energy_residual", "_J"}};
  }
  columns.resize(dimension);
  return columns;
}

}  // namespace vocalis::coupling
