#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "coupling/case/case_sections.hpp"

namespace vocalis::coupling {

namespace {

using base::UserError;
using Kind = MonitorKind;

const std::vector<std::pair<std::string, Kind>> monitor_kinds = {{"gap", Kind::gap},
                                                                 {"glottis", Kind::glottis},
                                                                 {"flux", Kind::flux},
                                                                 {"displacement", Kind::displacement},
                                                                 {"force", Kind::force},
                                                                 {"pressure", Kind::pressure},
                                                                 {"pressure_difference", Kind::pressure_difference},
                                                                 {"energy", Kind::energy}};

std::string read_name(base::Table& table, Kind kind) {
  if (kind == Kind::force) return read_plain_name_or(table, "name", "");
  if (kind == Kind::energy) return read_plain_name_or(table, "name", "energy");
  return read_plain_name(table, "name");
}

/// Where a flux is taken: a group of facets, or a line from one point to another.
void read_cut(base::Table& table, MonitorSettings& monitor, Case& config) {
  const bool is_line = table.has("from") || table.has("to");
  if (!is_line) {
    monitor.group = read_group(table, config);
    return;
  }
  if (table.has("group")) {
    throw UserError(table.place() + " needs a group, or a line by from and to", "both", "leave out one of them");
  }
  monitor.from = read_vector(table, "from", "m", config);
  monitor.to = read_vector(table, "to", "m", config);
  if (monitor.from == monitor.to) {
    throw UserError(table.place("to") + " must be another point than from", "the same point",
                    "give the two ends of a line");
  }
}

/// One fold before a plane, or two.
void read_glottis(base::Table& table, MonitorSettings& monitor, Case& config) {
  const std::vector<std::pair<std::string, int>> axes = {{"x", 0}, {"y", 1}, {"z", 2}};
  monitor.group = read_group(table, config);
  monitor.axis = table.choice_or<int>("axis", monitor.axis, axes);
  monitor.along = table.choice_or<int>("along", monitor.along, axes);
  if (monitor.along == monitor.axis) {
    throw UserError(table.place("along") + " must be another axis than the one across the glottis",
                    fmt::format("\"{}\"", "xyz"[monitor.along]), "give the axis along which the air flows");
  }
  if (table.has("other_group")) {
    if (table.has("plane") || table.has("mirrored")) {
      throw UserError(table.place() + " needs a second fold, or a plane with the mirror image of the first", "both",
                      "leave out other_group, or plane and mirrored");
    }
    monitor.other_group = read_group(table, config, "other_group");
  } else {
    monitor.plane = table.number_or("plane", monitor.plane, base::any_number, "m");
    monitor.mirrored = table.boolean_or("mirrored", monitor.mirrored);
  }
  monitor.depth = table.number_or("depth", monitor.depth, base::not_negative, "m");
  monitor.stations = table.integer_or("stations", monitor.stations, base::between(2, 10000));
  monitor.span_stations = table.integer_or("span_stations", monitor.span_stations, base::between(1, 10000));
}

MonitorSettings read_monitor(base::Table& table, Case& config) {
  MonitorSettings monitor;
  monitor.kind = table.choice("kind", monitor_kinds);
  monitor.name = read_name(table, monitor.kind);
  switch (monitor.kind) {
    case Kind::gap:
      monitor.group = read_group(table, config);
      monitor.mirrored = table.boolean_or("mirrored", monitor.mirrored);
      monitor.axis = table.choice_or<int>("axis", monitor.axis, {{"x", 0}, {"y", 1}, {"z", 2}});
      monitor.plane = table.number_or("plane", monitor.plane, base::any_number, "m");
      break;
    case Kind::glottis:
      read_glottis(table, monitor, config);
      break;
    case Kind::flux:
      read_cut(table, monitor, config);
      monitor.mirrored = table.boolean_or("mirrored", monitor.mirrored);
      break;
    case Kind::force:
      monitor.groups = read_groups(table, config);
      monitor.reference_force = table.number_or("reference_force", monitor.reference_force, base::not_negative, "N");
      break;
    case Kind::displacement:
    case Kind::pressure:
      monitor.position = read_vector(table, "position", "m", config);
      break;
    case Kind::pressure_difference:
      monitor.position = read_vector(table, "position", "m", config);
      monitor.other = read_vector(table, "other", "m", config);
      break;
    case Kind::energy:
      break;
  }
  return monitor;
}

}  // namespace

void read_monitors(base::Table& root, Case& config) {
  std::vector<std::string> names;
  for (base::Table& table : root.tables("monitor")) {
    config.monitors.push_back(read_monitor(table, config));
    names.push_back(config.monitors.back().name);
  }
  reject_duplicates(root, "[[monitor]]", names);
}

void read_statistics(base::Table& root, Case& config) {
  auto table = root.table_if("statistics");
  if (!table) return;
  StatisticsSettings& statistics = config.statistics.emplace();
  statistics.kind = table->choice<StatisticsKind>(
      "kind",
      {{"last", StatisticsKind::last}, {"periodic", StatisticsKind::periodic}, {"extrema", StatisticsKind::extrema}});
  if (statistics.kind == StatisticsKind::periodic) statistics.period_of = table->text("period_of");
  if (statistics.kind != StatisticsKind::last) {
    statistics.begin = table->number_or("begin", statistics.begin, base::not_negative, "s");
  }
  if (config.monitors.empty()) {
    throw UserError(table->place() + " needs a monitor", "no [[monitor]]", "add monitors, or leave [statistics] out");
  }
  if (statistics.begin >= config.time.end) {
    throw UserError(table->place("begin") + " must be earlier than time.end [s]", std::to_string(statistics.begin),
                    "choose an earlier begin, or a later end");
  }
}

}  // namespace vocalis::coupling
