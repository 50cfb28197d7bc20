#include "coupling/phonation/phonation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"
#include "coupling/monitors/columns_in_history.hpp"
#include "coupling/phonation/cycle_figures.hpp"

namespace vocalis::coupling {

namespace {

constexpr std::size_t cycles_that_count = 5;

/// The series of a run and what their names and units are.
struct Recorded {
  PhonationSeries series;
  std::vector<double> flow;  ///< behind series.flow: [m^3/s], or a plane glottis' [m^2/s]
  MonitorColumn opening;     ///< "area", "_m2" or "gap", "_m"
  std::string flow_unit;     ///< "m3_s" or "m2_s"
  std::vector<MonitorColumn> displacements;
};

const MonitorSettings* first_of_kind(const Case& config, MonitorKind kind) {
  const auto found = std::find_if(config.monitors.begin(), config.monitors.end(),
                                  [&](const MonitorSettings& monitor) { return monitor.kind == kind; });
  return found == config.monitors.end() ? nullptr : &*found;
}

/// The flow of the first monitor of kind flux, in the unit of the glottis.
void add_flow(const Case& config, const MonitorSettings& glottis, const io::Series& history, Recorded& recorded) {
  recorded.flow.assign(recorded.series.glottal_flow.begin(), recorded.series.glottal_flow.end());
  if (const MonitorSettings* flux = first_of_kind(config, MonitorKind::flux)) {
    const std::vector<MonitorColumn> columns = columns_in(history, *flux);
    if (columns.empty()) return;
    recorded.flow = *history.find(columns.front().name());
    const bool is_per_metre = columns.front().unit == "_m2_s" && glottis.depth > 0;
    for (double& value : recorded.flow) value *= is_per_metre ? glottis.depth : 1;
    recorded.flow_unit = is_per_metre ? "m3_s" : columns.front().unit.substr(1);
  }
}

std::optional<Recorded> find_series(const Case& config, const MonitorSettings& glottis, const io::Series& history) {
  Recorded recorded;
  PhonationSeries& series = recorded.series;
  series.times = *history.find("time_s");
  for (const auto& [stem, unit] : columns_in(history, glottis)) {
    const std::vector<double>& values = *history.find(stem + unit);
    const std::string quantity = stem.substr(glottis.name.size() + 1);
    if (quantity == "gap" || quantity == "area") {  // the area comes later, where there is one
      series.opening = values;
      recorded.opening = {quantity, unit};
    } else if (quantity == "flow") {
      series.glottal_flow = values;
      recorded.flow_unit = unit.substr(1);
    } else if (quantity == "speed") {
      series.speed = values;
    } else if (quantity == "impact_stress") {
      series.impact_stress = values;
    }
  }
  if (series.opening.empty()) return {};
  add_flow(config, glottis, history, recorded);
  for (const MonitorSettings& monitor : config.monitors) {
    if (monitor.kind != MonitorKind::displacement) continue;
    for (const MonitorColumn& column : columns_in(history, monitor)) {
      series.displacements.emplace_back(*history.find(column.name()));
      recorded.displacements.push_back({column.stem + "_amplitude", column.unit});
    }
  }
  return recorded;
}

using Named = std::vector<std::pair<std::string, double>>;

Named named(const CycleFigures& figures, const Recorded& recorded) {
  Named result = {{"f0_Hz", figures.frequency},
                  {"open_quotient", figures.open_quotient},
                  {"open_quotient_above_20_percent", figures.wide_quotient},
                  {"closing_quotient", figures.closing_quotient},
                  {"speed_quotient", figures.speed_quotient},
                  {recorded.opening.stem + "_peak" + recorded.opening.unit, figures.cycle.largest_opening}};
  const auto add = [&](const std::string& name, bool is_measured, const std::optional<double>& value) {
    if (is_measured) result.emplace_back(name, value.value_or(std::numeric_limits<double>::quiet_NaN()));
  };
  const PhonationSeries& series = recorded.series;
  const std::string& unit = recorded.flow_unit;
  add("flow_peak_" + unit, !series.flow.empty(), figures.peak_flow);
  add("flow_mean_" + unit, !series.flow.empty(), figures.mean_flow);
  add("flow_declination_" + unit + "2", !series.flow.empty(), figures.declination);
  add("speed_peak_m_s", !series.speed.empty(), figures.peak_speed);
  add("jet_speed_m_s", !series.flow.empty(), figures.jet_speed);
  add("impact_stress_Pa", !series.impact_stress.empty(), figures.impact_stress);
  add("leak", !series.glottal_flow.empty(), figures.leak);
  return result;
}

/// Of the last five cycles: their mean, and of leaks the largest; of what they have.
double of_last_cycles(const std::string& name, const std::vector<double>& values) {
  double sum = 0, largest = -std::numeric_limits<double>::infinity();
  int count = 0;
  for (const double value : values) {
    if (std::isnan(value)) continue;
    sum += value;
    largest = std::max(largest, value);
    ++count;
  }
  if (count == 0) return std::numeric_limits<double>::quiet_NaN();
  return name == "leak" ? largest : sum / count;
}

void add_results(const std::string& glottis, const Recorded& recorded, Phonation& phonation) {
  const std::size_t count = std::min(cycles_that_count, phonation.cycles.size());
  for (std::size_t c = 0; c < phonation.columns.size(); ++c) {
    std::vector<double> last;
    for (std::size_t i = phonation.cycles.size() - count; i < phonation.cycles.size(); ++i) {
      last.push_back(phonation.cycles[i][c]);
    }
    const std::string& name = phonation.columns[c];
    const bool is_displacement = c + recorded.displacements.size() >= phonation.columns.size();
    const double value = of_last_cycles(name, last);
    if (std::isfinite(value) && name != "begin_s") {
      phonation.results[is_displacement ? name : glottis + "_" + name] = value;
    }
    if (name == "f0_Hz" && count == cycles_that_count) phonation.results[glottis + "_f0_spread"] = spread(last);
  }
}

}  // namespace

Phonation analyse_phonation(const Case& config, const io::Series& history) {
  Phonation phonation;
  const MonitorSettings* glottis = first_of_kind(config, MonitorKind::glottis);
  if (!glottis) return phonation;
  std::optional<Recorded> recorded = find_series(config, *glottis, history);
  if (!recorded || recorded->series.times.empty()) return phonation;
  PhonationSeries& series = recorded->series;
  series.flow = recorded->flow;
  for (const GlottalCycle& cycle : glottal_cycles(series.times, series.opening, 0)) {
    const CycleFigures figures = measure_cycle(cycle, series);
    phonation.columns = {"begin_s"};
    std::vector<double>& row = phonation.cycles.emplace_back(std::vector<double>{cycle.begin});
    for (const auto& [name, value] : named(figures, *recorded)) {
      phonation.columns.push_back(name);
      row.push_back(value);
    }
    for (std::size_t i = 0; i < recorded->displacements.size(); ++i) {
      phonation.columns.push_back(recorded->displacements[i].name());
      row.push_back(figures.amplitudes[i]);
    }
  }
  if (!phonation.cycles.empty()) add_results(glottis->name, *recorded, phonation);
  phonation.results[glottis->name + "_closures"] = count_closures(series.opening);
  phonation.results[glottis->name + "_cycles"] = static_cast<double>(phonation.cycles.size());
  return phonation;
}

void write_periods(const std::string& path, const Case& config, const Phonation& phonation) {
  std::ofstream file(path);
  file << "# case: " << config.name << '\n';
  file << fmt::format("{}\n", fmt::join(phonation.columns, ","));
  for (const std::vector<double>& cycle : phonation.cycles) file << fmt::format("{:.9g}\n", fmt::join(cycle, ","));
  file.close();
  if (!file) throw base::UserError("the cycles must be writable", path, "check the folder's rights and free space");
}

}  // namespace vocalis::coupling
