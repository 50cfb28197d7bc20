#include "coupling/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/resample.hpp"
#include "acoustic_solver/signals/voice.hpp"
#include "core/base/error.hpp"
#include "core/io/series_reader.hpp"
#include "core/io/wav.hpp"
#include "coupling/far_field/surface_series.hpp"
#include "coupling/monitors/columns_in_history.hpp"
#include "coupling/phonation/phonation.hpp"
#include "coupling/sound/sound_comparison.hpp"
#include "coupling/sound/spectra_file.hpp"

namespace vocalis::coupling {

namespace {

constexpr double analysis_rate = 44100;  // [Hz]

const std::vector<double>& column(const io::Series& series, const std::string& name, const std::string& file) {
  if (const std::vector<double>* found = series.find(name)) return *found;
  throw base::UserError("a run's file must have the columns of its case: " + file, "no column \"" + name + "\"",
                        "the file was changed, or belongs to another case: run the case again");
}

/// The part of a series from a time on.
std::vector<double> since(const std::vector<double>& times, const std::vector<double>& values, double begin) {
  const auto first = std::lower_bound(times.begin(), times.end(), begin) - times.begin();
  return {values.begin() + first, values.end()};
}

/// A series that begins with its first step, at the analysis rate from time 0 on, when all was at rest.
std::vector<double> from_zero(std::vector<double> times, std::vector<double> values) {
  if (times.empty()) return {};
  if (times.front() > 0) {
    times.insert(times.begin(), 0.0);
    values.insert(values.begin(), values.size() > 1 ? 2 * values[0] - values[1] : values[0]);
  }
  return acoustic::resample(times, values, analysis_rate);
}

std::vector<double> uniform_since(const std::vector<double>& series, double begin) {
  const auto first = std::min(series.size(), static_cast<std::size_t>(begin * analysis_rate));
  return {series.begin() + static_cast<std::ptrdiff_t>(first), series.end()};
}

/// When the voice begins: all boundary values have risen, the folds have had 0.3 of the run to forget the start, and
/// the statistics, where there are any, have begun.
double begin_of_voice(const Case& config) {
  double end = config.has_flow() ? 0.3 * config.time.end : 0;
  if (config.flow) {
    for (const fsi::FlowBoundary& boundary : config.flow->boundaries) end = std::max(end, boundary.ramp);
  }
  if (config.statistics) end = std::max(end, config.statistics->begin);
  return end;
}

double mean(const std::vector<double>& values) {
  return values.empty() ? 0 : std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void add_vibration(const std::vector<double>& gap, Figures& figures) {
  // A slow swing of the folds must not be taken for the pitch, so an octave below has to correlate clearly better.
  const acoustic::Growth growth = acoustic::growth(gap, analysis_rate, 0.01, {.octave_cost = 0.1});
  figures.vibration = acoustic::name(growth.trend);
  if (growth.trend == acoustic::Trend::none) return;
  figures.values["f0_Hz"] = growth.frequency;
  figures.values["vibration_factor_per_period"] = growth.factor;
  figures.values["vibration_periods"] = static_cast<double>(growth.amplitudes.size());
  figures.values["vibration_last_amplitude_m"] = growth.amplitudes.back();
}

void add_statistics(const Case& config, const io::Series& history, Figures& figures) {
  std::vector<MonitorColumn> columns;
  std::vector<std::vector<double>> values;
  for (const MonitorSettings& monitor : config.monitors) {
    for (const MonitorColumn& column : columns_in(history, monitor)) {
      columns.push_back(column);
      values.push_back(*history.find(column.name()));
    }
  }
  figures.values.merge(statistics(*config.statistics, *history.find("time_s"), columns, values));
}

void add_history(const Case& config, const io::Series& history, Figures& figures) {
  if (config.statistics) {
    add_statistics(config, history, figures);
    return;
  }
  const std::vector<double>& times = *history.find("time_s");
  const double begin = begin_of_voice(config);
  bool has_gap = false;
  for (const MonitorSettings& monitor : config.monitors) {
    const bool is_opening = monitor.kind == MonitorKind::gap || monitor.kind == MonitorKind::glottis;
    if (!is_opening && monitor.kind != MonitorKind::flux) continue;
    const std::vector<MonitorColumn> columns = columns_in(history, monitor);
    if (columns.empty()) continue;
    const std::vector<double>& values = *history.find(columns.front().name());
    const auto& [stem, unit] = columns.front();
    const std::vector<double> late = since(times, values, begin);
    if (late.empty()) continue;
    if (monitor.kind == MonitorKind::flux) {
      figures.values[monitor.name + "_mean" + unit] = mean(late);
      continue;
    }
    figures.values[stem + "_peak" + unit] = *std::max_element(late.begin(), late.end());
    figures.values[stem + "_least" + unit] = *std::min_element(late.begin(), late.end());
    if (!has_gap) add_vibration(uniform_since(from_zero(times, values), begin), figures);
    has_gap = true;
  }
}

void add_phonation(const Case& config, const io::Series& history, const std::string& file, Figures& figures) {
  const Phonation phonation = analyse_phonation(config, history);
  if (!phonation.cycles.empty()) write_periods(file, config, phonation);
  for (const auto& [name, value] : phonation.results) figures.values[name] = value;
}

/// The volume flow of the first monitor of its kind, at the analysis rate from time 0 on; empty if there is none.
std::vector<double> first_flux(const Case& config, const io::Series& history) {
  for (const MonitorSettings& monitor : config.monitors) {
    if (monitor.kind != MonitorKind::flux) continue;
    const std::vector<MonitorColumn> columns = columns_in(history, monitor);
    if (!columns.empty()) return from_zero(*history.find("time_s"), *history.find(columns.front().name()));
  }
  return {};
}

void add_formants(const std::vector<acoustic::Formant>& formants, const std::string& suffix, Figures& figures) {
  for (std::size_t i = 0; i < formants.size() && i < 5; ++i) {
    figures.values[fmt::format("F{}_Hz{}", i + 1, suffix)] = formants[i].frequency;
    if (std::isfinite(formants[i].bandwidth)) {
      figures.values[fmt::format("B{}_Hz{}", i + 1, suffix)] = formants[i].bandwidth;
    }
    if (std::isfinite(formants[i].spread)) {
      figures.values[fmt::format("F{}_spread_Hz{}", i + 1, suffix)] = formants[i].spread;
    }
  }
}

/// The name of the first microphone at a place: others there are compared with it.
std::string first_at(const Case& config, const std::array<double, 3>& position) {
  for (const auto& microphone : config.microphones) {
    if (microphone.position == position) return microphone.name;
  }
  for (const auto& microphone : config.surface_microphones) {
    if (microphone.position == position) return microphone.name;
  }
  return "";
}

/// Whose monitors watched the flow: this run's, or those of the run whose flow it replays.
struct Watched {
  Case config;
  std::filesystem::path folder;
};

std::optional<Watched> watched(const Case& config, const std::string& folder) {
  if (config.flow) return Watched{config, folder};
  const auto* record = config.given_flow ? std::get_if<FlowRecord>(&*config.given_flow) : nullptr;
  if (!record || record->run.empty()) return {};
  const std::filesystem::path run = record->run;
  if (!std::filesystem::exists(run / "resolved.toml") || !std::filesystem::exists(run / "history.csv")) return {};
  return Watched{read_case(MPI_COMM_SELF, (run / "resolved.toml").string(), {}), run};
}

}  // namespace

std::vector<Channel> channels(const Case& config) {
  std::vector<Channel> result;
  for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
    const std::string& solver = config.acoustics[i].name;
    for (const acoustic::MicrophoneSettings& microphone : config.microphones) {
      const std::string suffix = config.acoustics.size() == 1 ? microphone.name : solver + "." + microphone.name;
      result.push_back({suffix, "pressure_Pa." + suffix, solver, microphone.name, microphones_file(config, i)});
    }
  }
  for (const SurfaceMicrophoneSettings& microphone : config.surface_microphones) {
    const std::string method = microphone.method == SurfaceMethod::curle ? " (curle)" : " (fwh)";
    result.push_back({microphone.name, "pressure_Pa." + microphone.name, microphone.name + method,
                      first_at(config, microphone.position), surface_microphones_file(config)});
  }
  return result;
}

std::string microphones_file(const Case& config, std::size_t solver) {
  return solver == 0 ? "microphones.csv" : "microphones_" + config.acoustics[solver].name + ".csv";
}

Figures evaluate_run(const Case& config, const std::string& folder) {
  const std::filesystem::path run = folder;
  Figures figures;
  std::vector<double> volume_flow;  // through the first monitor of kind flux: what the voice is made of
  const std::optional<Watched> flow = watched(config, folder);
  const double begin = begin_of_voice(flow ? flow->config : config);
  if (flow) {
    const std::string file = (flow->folder / "history.csv").string();
    const io::Series history = io::read_series(file);
    column(history, "time_s", file);
    add_history(flow->config, history, figures);
    if (!flow->config.statistics) add_phonation(flow->config, history, (run / "periods.csv").string(), figures);
    volume_flow = first_flux(flow->config, history);
  }
  const std::vector<Channel> heard = channels(config);
  if (heard.empty()) return figures;

  std::optional<double> pitch;  // of the prescribed source or of the folds
  if (config.source) pitch = acoustic::prescribed_pitch(config.source->pulse);
  if (const auto found = figures.values.find("f0_Hz"); found != figures.values.end()) pitch = found->second;
  for (const Channel& channel : heard) {
    const std::string file = (run / channel.file).string();
    const io::Series recorded = io::read_series(file);
    const std::vector<double>& times = column(recorded, "time_s", file);
    const std::vector<double>& pressure = column(recorded, channel.column, file);
    const std::vector<double> sound = from_zero(times, pressure);
    io::write_wav((run / ("microphone_" + channel.suffix + ".wav")).string(), sound);
    const std::vector<double> source =
        config.source ? from_zero(times, column(recorded, source_column, file)) : volume_flow;
    SoundAnalysis analysis = analyse_sound(sound, source, analysis_rate, begin, pitch);
    // The first microphone's formants carry the plain names F1_Hz, ...
    add_formants(analysis.formants, figures.sounds.empty() ? "" : "." + channel.suffix, figures);
    if (analysis.pitch) figures.values.try_emplace("f0_Hz", *analysis.pitch);
    figures.values["SPL_dB." + channel.suffix] = analysis.level;
    figures.sounds.push_back({channel, std::move(analysis)});
  }
  write_spectra((run / "spectra.csv").string(), config, figures.sounds);
  write_third_octaves((run / "third_octaves.csv").string(), config, figures.sounds);
  write_harmonics((run / "harmonics.csv").string(), config, figures.sounds);
  return figures;
}

}  // namespace vocalis::coupling
