#include "coupling/figures.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/voice.hpp"
#include "core/base/error.hpp"
#include "core/io/series_reader.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

constexpr double step = 5e-6, ramp = 0.01;

/// A run folder of one rank that is gone afterwards.
class Folder {
 public:
  Folder() : path_(std::filesystem::temp_directory_path() / "vocalis_figures") {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

Case case_of(const std::vector<std::string>& solvers, bool with_flow) {
  Case config;
  config.name = "made_up";
  for (const std::string& name : solvers) {
    acoustic::AcousticSettings settings;
    settings.name = name;
    config.acoustics.push_back(settings);
  }
  config.microphones = {{"mouth", {0, 0, 0}}};
  if (!with_flow) {
    config.source.emplace();
    return config;
  }
  fsi::FlowBoundary inlet;
  inlet.ramp = ramp;
  config.flow.emplace().boundaries = {inlet};
  MonitorSettings gap, flux;
  gap.name = "gap";
  flux.name = "flow";
  flux.kind = MonitorKind::flux;
  config.monitors = {gap, flux};
  return config;
}

/// 60 ms of folds that swing with 130 Hz by 0.1 mm about 0.5 mm, after a ramp in which all is larger.
void write_history(const Folder& folder, double end = 0.06) {
  std::ofstream file(folder.file("history.csv"));
  file.precision(17);
  file << "# case: made_up\nstep,time_s,dt_s,gap_m,flow_m2_s\n";
  for (int n = 1; n * 2e-5 <= end * (1 + 1e-12); ++n) {
    const double t = n * 2e-5, before = t < ramp ? 1 : 0;
    file << n << ',' << t << ",2e-5," << 5e-4 + 1e-4 * std::sin(2 * M_PI * 130 * t) + 1e-2 * before << ','
         << 0.2 + 0.1 * std::sin(2 * M_PI * 130 * t) + 10 * before << '\n';
  }
}

/// A tone after the ramp, of a given amplitude [Pa].
void write_tone(const Folder& folder, const std::string& name, const std::string& column, double amplitude) {
  std::ofstream file(folder.file(name));
  file.precision(17);
  file << "# case: made_up\ntime_s," << column << '\n';
  for (int n = 1; n * step <= 0.06; ++n) {
    const double t = n * step;
    file << t << ',' << (t < ramp ? 0 : amplitude * std::sin(2 * M_PI * 130 * t)) << '\n';
  }
}

/// 120 ms of a voiced flux and of what a resonance makes of it.
void write_driven(const Folder& folder, const acoustic::PulseFlux& flux, double resonance, double bandwidth) {
  std::ofstream file(folder.file("microphones.csv"));
  file.precision(17);
  file << "time_s,source_m_s,pressure_Pa.mouth\n";
  const double radius = std::exp(-M_PI * bandwidth * step), turn = 2 * M_PI * resonance * step;
  double last = 0, before = 0;
  for (int n = 1; n <= 24000; ++n) {
    const double here = 2 * radius * std::cos(turn) * last - radius * radius * before + flux.rate(n * step);
    before = last;
    last = here;
    file << n * step << ',' << flux.value(n * step) << ',' << 1e-6 * here << '\n';
  }
}

double level(double amplitude) { return 20 * std::log10(amplitude / std::sqrt(2.0) / 20e-6); }

}  // namespace

TEST_CASE("a microphone's figures carry the solver's name where there are several", "[serial]") {
  const auto one = channels(case_of({"sound"}, true));
  REQUIRE(one.size() == 1);
  CHECK(one[0].suffix == "mouth");
  CHECK(one[0].column == "pressure_Pa.mouth");
  CHECK(one[0].file == "microphones.csv");
  const auto two = channels(case_of({"near", "far"}, true));
  REQUIRE(two.size() == 2);
  CHECK(two[0].column == "pressure_Pa.near.mouth");
  CHECK(two[0].file == "microphones.csv");
  CHECK(two[1].suffix == "far.mouth");
  CHECK(two[1].file == "microphones_far.csv");
}

TEST_CASE("figures of a made-up run are those that it was made of, from the end of the ramp on", "[serial]") {
  const Folder folder;
  write_history(folder);
  write_tone(folder, "microphones.csv", "pressure_Pa.mouth", 2);
  const Figures figures = evaluate_run(case_of({"sound"}, true), folder.path());
  CHECK(figures.values.at("gap_peak_m") == Approx(6e-4).epsilon(1e-3));
  CHECK(figures.values.at("gap_least_m") == Approx(4e-4).epsilon(1e-3));
  CHECK(figures.values.at("flow_mean_m2_s") == Approx(0.2).epsilon(0.02));  // 6.5 periods
  CHECK(figures.values.at("SPL_dB.mouth") == Approx(level(2)).margin(0.1));
  CHECK(std::filesystem::exists(folder.file("microphone_mouth.wav")));
  const io::Series spectra = io::read_series(folder.file("spectra.csv").string());
  REQUIRE(spectra.find("frequency_Hz"));
  const auto& psd = *spectra.find("psd_dB.mouth");
  const auto loudest = std::max_element(psd.begin(), psd.end()) - psd.begin();
  CHECK((*spectra.find("frequency_Hz"))[loudest] == Approx(130).margin(15));
}

TEST_CASE("monitors whose names begin alike keep their own columns", "[serial]") {
  const Folder folder;
  Case config = case_of({}, true);
  config.microphones.clear();
  MonitorSettings other = config.monitors.front();
  other.name = "gap_2";
  config.monitors.push_back(other);
  MonitorSettings pressure;  // says nothing about a voice
  pressure.name = "front";
  pressure.kind = MonitorKind::pressure;
  config.monitors.push_back(pressure);
  std::ofstream file(folder.file("history.csv"));
  file << "step,time_s,dt_s,gap_m,flow_m2_s,gap_2_m,front_Pa\n";
  for (int n = 1; n <= 100; ++n) file << n << ',' << n * 1e-3 << ",1e-3,1,3,2,9\n";
  file.close();
  const Figures figures = evaluate_run(config, folder.path());
  CHECK(figures.values.at("gap_peak_m") == 1);
  CHECK(figures.values.at("gap_2_peak_m") == 2);
  CHECK(figures.values.at("flow_mean_m2_s") == 3);
  CHECK(figures.values.count("gap_peak_2_m") == 0);
  for (const auto& [name, value] : figures.values) CHECK(name.find("front") == std::string::npos);
}

TEST_CASE("a case's statistics say what becomes of its monitors' columns, instead of a voice's figures", "[serial]") {
  const Folder folder;
  Case config = case_of({}, true);
  config.microphones.clear();
  MonitorSettings tip;
  tip.name = "tip";
  tip.kind = MonitorKind::displacement;
  config.monitors.push_back(tip);
  std::ofstream file(folder.file("history.csv"));
  file << "step,time_s,dt_s,gap_m,flow_m2_s,tip_x_m,tip_y_m\n";
  for (int n = 1; n <= 1000; ++n) {
    const double t = n * 1e-3;
    file << n << ',' << t << ",1e-3,1,3," << 5 + std::sin(2 * M_PI * 10 * t) << ",7\n";
  }
  file.close();
  config.statistics = {StatisticsKind::last, "", 0};
  const Figures last = evaluate_run(config, folder.path());
  CHECK(last.values.size() == 4);
  CHECK(last.values.at("tip_y_m") == 7);
  CHECK(last.values.at("flow_m2_s") == 3);
  config.statistics = {StatisticsKind::periodic, "tip_x_m", 0.2};
  const Figures periodic = evaluate_run(config, folder.path());
  CHECK(periodic.values.at("tip_x_mean_m") == Approx(5).epsilon(1e-3));
  CHECK(periodic.values.at("tip_x_amplitude_m") == Approx(1).epsilon(1e-3));
  CHECK(periodic.values.at("tip_x_frequency_Hz") == Approx(10).epsilon(1e-3));
  CHECK(periodic.values.at("flow_mean_m2_s") == 3);
  CHECK(periodic.vibration.empty());
}

TEST_CASE("every acoustic solver is read from its own file", "[serial]") {
  const Folder folder;
  write_history(folder);
  write_tone(folder, "microphones.csv", "pressure_Pa.near.mouth", 2);
  write_tone(folder, "microphones_far.csv", "pressure_Pa.far.mouth", 0.5);
  const Figures figures = evaluate_run(case_of({"near", "far"}, true), folder.path());
  CHECK(figures.values.at("SPL_dB.near.mouth") == Approx(level(2)).margin(0.1));
  CHECK(figures.values.at("SPL_dB.far.mouth") == Approx(level(0.5)).margin(0.1));
  const io::Series spectra = io::read_series(folder.file("spectra.csv").string());
  CHECK(spectra.find("psd_dB.near.mouth"));
  CHECK(spectra.find("psd_dB.far.mouth"));
}

TEST_CASE("a pulse's ring gives the formant, its bandwidth and the transfer function", "[serial]") {
  const Folder folder;
  {
    std::ofstream file(folder.file("microphones.csv"));
    file.precision(17);
    file << "time_s,source_m_s,pressure_Pa.mouth\n";
    for (int n = 1; n <= 8000; ++n) {
      const double t = n * step, after = t - 3e-4;
      const double ring = after > 0 ? std::exp(-M_PI * 60 * after) * std::sin(2 * M_PI * 500 * after) : 0;
      file << t << ',' << std::exp(-std::pow((t - 2e-4) / 4e-5, 2)) << ',' << ring << '\n';
    }
  }
  const Figures figures = evaluate_run(case_of({"sound"}, false), folder.path());
  CHECK(figures.values.at("F1_Hz") == Approx(500).epsilon(1e-3));
  CHECK(figures.values.at("B1_Hz") == Approx(60).epsilon(0.02));
  CHECK(!figures.values.contains("F1_spread_Hz"));  // of a single model
  CHECK(io::read_series(folder.file("spectra.csv").string()).find("transfer_dB.mouth"));
}

TEST_CASE("a source that goes on gives the formant of the response, the pitch and the harmonics", "[serial]") {
  const Folder folder;
  write_driven(folder, acoustic::PulseFlux(acoustic::RosenbergPulse{.fundamental_frequency = 125}), 530, 60);
  const Figures figures = evaluate_run(case_of({"sound"}, false), folder.path());
  CHECK(figures.values.at("F1_Hz") == Approx(530).epsilon(1e-3));
  CHECK(figures.values.at("B1_Hz") == Approx(60).epsilon(0.02));
  CHECK(figures.values.at("F1_spread_Hz") < 0.001 * 530);
  CHECK(figures.values.at("f0_Hz") == Approx(125).epsilon(1e-3));
  const io::Series harmonics = io::read_series(folder.file("harmonics.csv").string());
  const auto& frequency = *harmonics.find("frequency_Hz.mouth");
  const auto& loudness = *harmonics.find("level_dB.mouth");
  REQUIRE(frequency.size() > 10);
  CHECK(frequency[3] == Approx(500).epsilon(1e-3));
  const auto loudest = std::max_element(loudness.begin(), loudness.end()) - loudness.begin();
  CHECK(loudest == 3);  // 500 Hz
}

TEST_CASE("f0 and harmonics are those of the source, even where a resonance without losses rings louder", "[serial]") {
  const Folder folder;
  Case config = case_of({"sound"}, false);
  const auto check = [&](double f0, double tolerance) {
    const Figures figures = evaluate_run(config, folder.path());
    CHECK(figures.values.at("f0_Hz") == Approx(f0).epsilon(tolerance));
    const std::vector<acoustic::Harmonic>& harmonics = figures.sounds.at(0).analysis.harmonics;
    REQUIRE(harmonics.size() == 20);  // up to 6000 Hz
    CHECK(harmonics[1].frequency == Approx(2 * f0).epsilon(tolerance));
  };
  const acoustic::LiljencrantsFantPulse lf{.fundamental_frequency = 299.7};
  write_driven(folder, acoustic::PulseFlux(lf), 514.7, 0);
  const io::Series written = io::read_series(folder.file("microphones.csv").string());
  const double of_sound = *acoustic::fundamental_frequency(*written.find("pressure_Pa.mouth"), 1 / step).frequency;
  REQUIRE(std::abs(of_sound / 299.7 - 1) > 0.05);
  check(299.7, 1e-3);  // a source that does not know its pitch has it in its samples
  config.source->pulse = lf;
  check(299.7, 1e-12);
  const acoustic::RosenbergPulse rosenberg{.fundamental_frequency = 298};
  write_driven(folder, acoustic::PulseFlux(rosenberg), 514.7, 0);
  config.source->pulse = rosenberg;
  check(298, 1e-12);
}

TEST_CASE("a run that hardly began is evaluated, too", "[serial]") {
  const Folder folder;
  for (const int rows : {0, 1, 2, 3, 20}) {
    write_history(folder, rows * 2e-5);
    std::ofstream file(folder.file("microphones.csv"));
    file << "time_s,pressure_Pa.mouth\n";
    for (int n = 1; n <= rows; ++n) file << n * 2e-5 << ',' << 1e-3 * n << '\n';
    file.close();
    CHECK_NOTHROW(evaluate_run(case_of({"sound"}, true), folder.path()));
  }
}

TEST_CASE("files that are missing or of another case are refused", "[serial]") {
  const Folder folder;
  const Case config = case_of({"sound"}, true);
  CHECK_THROWS_AS(evaluate_run(config, folder.path()), base::UserError);
  write_history(folder);
  CHECK_THROWS_AS(evaluate_run(config, folder.path()), base::UserError);
  write_tone(folder, "microphones.csv", "pressure_Pa.ear", 1);
  CHECK_THROWS_WITH(evaluate_run(config, folder.path()), Catch::Contains("no column \"pressure_Pa.mouth\""));
  std::ofstream(folder.file("history.csv")) << "step,gap_m\n1,2\n";
  CHECK_THROWS_WITH(evaluate_run(config, folder.path()), Catch::Contains("no column \"time_s\""));
}
