#include "coupling/phonation/phonation.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "coupling/figures.hpp"
#include "tests/coupling/phonation/waveforms.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

constexpr double depth = 0.015;
const test::Triangle pulse{.height = 1e-3};  // of the gap [m]

Case larynx(double length) {
  Case config;
  config.name = "made_up";
  config.time.end = 0.1;
  config.flow.emplace();
  MonitorSettings glottis, flux, tip;
  glottis.kind = MonitorKind::glottis;
  glottis.name = "folds";
  glottis.depth = length;
  flux.kind = MonitorKind::flux;
  flux.name = "mouth";
  tip.kind = MonitorKind::displacement;
  tip.name = "tip";
  config.monitors = {glottis, flux, tip};
  return config;
}

/// 100 ms of a plane larynx; what is given as per metre and what with a depth. The first period is longer.
io::Series history_of(double length) {
  io::Series history;
  history.columns = {"time_s", "folds_gap_m"};
  if (length > 0) history.columns.push_back("folds_area_m2");
  history.columns.push_back(length > 0 ? "folds_flow_m3_s" : "folds_flow_m2_s");
  for (const char* name :
       {"folds_speed_m_s", "folds_impact_stress_Pa", "folds_contact", "mouth_m2_s", "tip_x_m", "tip_y_m"}) {
    history.columns.emplace_back(name);
  }
  history.values.resize(history.columns.size());
  const double scale = length > 0 ? length : 1;
  for (int n = 1; n <= 10000; ++n) {
    const double t = n * 1e-5, gap = pulse(t);
    std::vector<double> row = {t, gap};
    if (length > 0) row.push_back(gap * length);
    row.push_back((gap > 0 ? 20 * gap : 1e-5) * scale);
    for (const double value : {30 + 1e3 * gap, gap > 0 ? 0.0 : 700.0, gap > 0 ? 0.0 : 12.0, 20 * gap, 0.0, 0.5 * gap})
      row.push_back(value);
    for (std::size_t c = 0; c < row.size(); ++c) history.values[c].push_back(row[c]);
  }
  return history;
}

}  // namespace

TEST_CASE("a run's phonation carries the monitor's name, and units of its folds' length", "[serial]") {
  const Phonation with_depth = analyse_phonation(larynx(depth), history_of(depth));
  CHECK(with_depth.columns ==
        std::vector<std::string>{"begin_s", "f0_Hz", "open_quotient", "open_quotient_above_20_percent",
                                 "closing_quotient", "speed_quotient", "area_peak_m2", "flow_peak_m3_s",
                                 "flow_mean_m3_s", "flow_declination_m3_s2", "speed_peak_m_s", "jet_speed_m_s",
                                 "impact_stress_Pa", "leak", "tip_x_amplitude_m", "tip_y_amplitude_m"});
  CHECK(with_depth.cycles.size() == 12);
  const auto& results = with_depth.results;
  CHECK(results.at("folds_f0_Hz") == Approx(125).epsilon(1e-4));
  CHECK(results.at("folds_f0_spread") == Approx(0).margin(1e-3));
  CHECK(results.at("folds_open_quotient") == Approx(4.5 / 8).epsilon(0.01));
  CHECK(results.at("folds_area_peak_m2") == Approx(1e-3 * depth).epsilon(0.01));
  CHECK(results.at("folds_flow_peak_m3_s") == Approx(0.02 * depth).epsilon(0.01));
  CHECK(results.at("folds_flow_mean_m3_s") == Approx(0.02 * depth * 4.5 / 16).epsilon(0.01));
  CHECK(results.at("folds_flow_declination_m3_s2") == Approx(0.02 * depth / 1.5e-3).epsilon(1e-3));
  CHECK(results.at("folds_speed_peak_m_s") == Approx(31).epsilon(0.01));
  CHECK(results.at("folds_leak") == Approx(1e-5 / 0.02).epsilon(0.01));
  CHECK(results.at("folds_impact_stress_Pa") == 700);
  CHECK(results.at("folds_closures") == 12);
  CHECK(results.at("folds_cycles") == 12);
  CHECK(results.at("tip_x_amplitude_m") == 0);
  CHECK(results.at("tip_y_amplitude_m") == Approx(2.5e-4).epsilon(0.01));
  const auto per_metre = analyse_phonation(larynx(0), history_of(0)).results;
  CHECK(per_metre.at("folds_gap_peak_m") == Approx(1e-3).epsilon(0.01));
  CHECK(per_metre.at("folds_flow_peak_m2_s") == Approx(0.02).epsilon(0.01));
  CHECK(per_metre.at("folds_leak") == Approx(results.at("folds_leak")));
}

TEST_CASE("without a flux monitor the flow is the one past the folds", "[serial]") {
  Case config = larynx(depth);
  config.monitors.erase(config.monitors.begin() + 1);
  const Phonation phonation = analyse_phonation(config, history_of(depth));
  CHECK(phonation.results.at("folds_flow_peak_m3_s") == Approx(0.02 * depth).epsilon(0.01));
}

TEST_CASE("the spread of f0 is that of the last five cycles, means are of them", "[serial]") {
  io::Series history = history_of(0);
  std::vector<double>& times = history.values[0];
  for (double& time : times)
    time = time < 0.08 ? time : 0.08 + 1.02 * (time - 0.08);  // the last two periods are longer
  const auto results = analyse_phonation(larynx(0), history).results;
  CHECK(results.at("folds_f0_spread") == Approx(0.02).epsilon(0.1));
  CHECK(results.at("folds_f0_Hz") < 124.6);
}

TEST_CASE("what a run does not have, it says nothing about", "[serial]") {
  Case config = larynx(0);
  io::Series history = history_of(0);
  for (std::vector<double>& values : history.values) values.resize(500);  // less than a period
  const Phonation early = analyse_phonation(config, history);
  CHECK(early.cycles.empty());
  CHECK(early.results == std::map<std::string, double>{{"folds_closures", 1}, {"folds_cycles", 0}});
  for (std::vector<double>& values : history.values) values.clear();
  CHECK(analyse_phonation(config, history).results.empty());
  config.monitors.erase(config.monitors.begin());
  CHECK(analyse_phonation(config, history_of(0)).results.empty());
}

TEST_CASE("a run folder gets periods.csv, and its figures what is in there", "[serial]") {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "vocalis_phonation";
  std::filesystem::create_directories(folder);
  const io::Series history = history_of(depth);
  {
    std::ofstream file(folder / "history.csv");
    file.precision(17);
    for (std::size_t c = 0; c < history.columns.size(); ++c) file << (c ? "," : "") << history.columns[c];
    for (std::size_t row = 0; row < history.values[0].size(); ++row) {
      for (std::size_t c = 0; c < history.columns.size(); ++c) file << (c ? ',' : '\n') << history.values[c][row];
    }
    file << '\n';
  }
  const Figures figures = evaluate_run(larynx(depth), folder.string());
  CHECK(figures.values.at("folds_open_quotient") == Approx(4.5 / 8).epsilon(0.01));
  CHECK(figures.values.at("f0_Hz") == Approx(125).epsilon(1e-3));
  CHECK(figures.values.at("folds_gap_least_m") == 0);
  const io::Series periods = io::read_series((folder / "periods.csv").string());
  REQUIRE(periods.find("leak"));
  CHECK(periods.find("leak")->size() == 12);
  CHECK(periods.find("f0_Hz")->back() == Approx(125).epsilon(1e-3));
  std::filesystem::remove_all(folder);
}
