#include "coupling/monitors/monitor_settings.hpp"

namespace vocalis::coupling {

namespace {

std::vector<MonitorColumn> columns_of_glottis(const MonitorSettings& monitor, int dimension) {
  std::vector<MonitorColumn> columns = {{monitor.name + "_gap", "_m"}};
  if (dimension == 3 || monitor.depth > 0) columns.push_back({monitor.name + "_area", "_m2"});
  if (dimension == 2) columns.push_back({monitor.name + "_flow", monitor.depth > 0 ? "_m3_s" : "_m2_s"});
  columns.push_back({monitor.name + "_speed", "_m_s"});
  columns.push_back({monitor.name + "_impact_stress", "_Pa"});
  columns.push_back({monitor.name + "_contact", ""});
  return columns;
}

}  // namespace

std::vector<MonitorColumn> columns_of(const MonitorSettings& monitor, int dimension) {
  const std::string prefix = monitor.name.empty() ? "" : monitor.name + "_";
  std::vector<MonitorColumn> columns;
  switch (monitor.kind) {
    case MonitorKind::gap:
      return {{monitor.name, "_m"}};
    case MonitorKind::glottis:
      return columns_of_glottis(monitor, dimension);
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
