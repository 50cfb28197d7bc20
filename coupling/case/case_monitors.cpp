#include <string>
#include <vector>

#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

void read_monitors(base::Table& root, Case& config) {
  std::vector<std::string> names;
  for (base::Table& table : root.tables("monitor")) {
    MonitorSettings monitor;
    monitor.name = read_plain_name(table, "name");
    monitor.kind = table.choice<MonitorKind>(
        "kind", {{"gap", MonitorKind::gap}, {"flux", MonitorKind::flux}, {"displacement", MonitorKind::displacement}});
    if (monitor.kind == MonitorKind::displacement) {
      monitor.position = read_vector(table, "position", "m", config);
    } else {
      monitor.group = read_group(table, config);
      monitor.mirrored = table.boolean_or("mirrored", monitor.mirrored);
    }
    if (monitor.kind == MonitorKind::gap) {
      monitor.axis = table.choice_or<int>("axis", monitor.axis, {{"x", 0}, {"y", 1}, {"z", 2}});
      monitor.plane = table.number_or("plane", monitor.plane, base::any_number, "m");
    }
    names.push_back(monitor.name);
    config.monitors.push_back(monitor);
  }
  reject_duplicates(root, "[[monitor]]", names);
}

}  // namespace vocalis::coupling
