#include "coupling/series_headers.hpp"

#include <fmt/format.h>

#include "coupling/figures.hpp"

namespace vocalis::coupling {

namespace {

using Header = io::SeriesWriter::Header;

std::string words(const acoustic::MicrophoneSettings& microphone) {
  if (microphone.kind == acoustic::MicrophoneKind::mesh) return "on the mesh";
  std::string mirrors;
  for (const acoustic::MirrorPlane& mirror : microphone.mirrors) {
    mirrors += fmt::format(", mirrored at {} = {} m", "xyz"[mirror.axis], mirror.position);
  }
  return fmt::format("far field, by Kirchhoff's integral over '{}'{}", microphone.surface, mirrors);
}

std::string meaning_of_sound(const std::string& analogy) {
  if (analogy == "lighthill" || analogy == "vortex" || analogy == "ape") {
    return "pressure of the wave equation, which is for the whole, less p_ic";
  }
  return "acoustic pressure, of the wave equation with the analogy's source";
}

}  // namespace

std::vector<std::string> history_columns(const Simulation& simulation) {
  std::vector<std::string> columns = {
      "step", "time_s", "dt_s", "newton_iterations", "jacobians", "acoustic_iterations", "smallest_quality"};
  if (simulation.clock().tolerance > 0) columns.push_back("local_error");
  if (simulation.monitors()) {
    const auto& more = simulation.monitors()->columns();
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

std::vector<std::string> microphone_columns(const Case& config, std::size_t solver) {
  std::vector<std::string> columns = {"time_s"};
  if (config.source) columns.push_back(source_column);
  for (const Channel& channel : channels(config)) {
    if (channel.solver != config.acoustics[solver].name) continue;
    columns.push_back(channel.column);
    if (!config.has_flow()) continue;
    columns.push_back("p_a_Pa." + channel.suffix);
    columns.push_back("p_ic_Pa." + channel.suffix);
  }
  return columns;
}

io::SeriesWriter::Header microphone_header(const Case& config, std::size_t solver,
                                           const std::vector<std::int32_t>& in_flow) {
  const acoustic::AcousticSettings& settings = config.acoustics[solver];
  Header header = {{"case", config.name},
                   {"solver", settings.name},
                   {"units", "SI: times [s], instantaneous pressures [Pa], positions [m], speeds [m/s]"}};
  if (config.has_flow()) {
    header.emplace_back("pressure_Pa", "p_a + p_ic, the whole deviation from the pressure at rest");
    header.emplace_back("p_a_Pa", meaning_of_sound(settings.analogy.name));
    header.emplace_back("p_ic_Pa", "pressure of the incompressible flow, linear in time over a step of the flow");
    header.emplace_back("analogy", settings.analogy.name);
    header.emplace_back("sign", "p_a adds to p_ic; the mass source of pressure_rate is -(1 / (rho c^2)) dp_ic/dt");
  } else {
    header.emplace_back("pressure_Pa", "acoustic pressure, of the wave equation driven by source_m_s");
    header.emplace_back("analogy", "none");
    header.emplace_back("sign", "source_m_s is positive into the air");
  }
  header.emplace_back("speed_of_sound_m_s", fmt::format("{}", settings.speed_of_sound));
  header.emplace_back("density_kg_m3", fmt::format("{}", settings.density));
  for (std::size_t m = 0; m < config.microphones.size(); ++m) {
    const acoustic::MicrophoneSettings& microphone = config.microphones[m];
    const auto& [x, y, z] = microphone.position;
    header.emplace_back("position_m." + microphone.name, fmt::format("{} {} {}", x, y, z));
    header.emplace_back("microphone." + microphone.name, words(microphone));
    if (!config.has_flow()) continue;
    header.emplace_back("p_ic." + microphone.name, in_flow[m] ? "inside of the flow" : "0: outside of the flow");
  }
  return header;
}

std::vector<std::string> kymogram_columns(const Stations& stations) {
  std::vector<std::string> columns = {"step", "time_s"};
  for (int i = 0; i < stations.count; ++i) columns.push_back(fmt::format("opening_m.{:.9g}", stations.place(i)));
  return columns;
}

io::SeriesWriter::Header kymogram_header(const Case& config, const Glottis& glottis) {
  return {
      {"case", config.name},
      {"monitor", glottis.settings.name},
      {"opening_m", fmt::format("distance of the folds [m], 0 where contact cells seal them; in space the mean over "
                                "their length. Of each column at this {} [m]",
                                "xyz"[glottis.grid.along.axis])}};
}

}  // namespace vocalis::coupling
