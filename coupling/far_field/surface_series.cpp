#include "coupling/far_field/surface_series.hpp"

#include <fmt/format.h>

#include <filesystem>

namespace vocalis::coupling {

namespace {

std::string words(const SurfaceMicrophoneSettings& microphone) {
  const bool is_curle = microphone.method == SurfaceMethod::curle;
  std::string mirrors;
  for (const acoustic::MirrorPlane& mirror : microphone.mirrors) {
    mirrors += fmt::format(", mirrored at {} = {} m", "xyz"[mirror.axis], mirror.position);
  }
  return fmt::format("far field, {} over '{}', {}{}{}, c = {} m/s",
                     is_curle ? "Curle's integral" : "the integral of Ffowcs Williams and Hawkings",
                     fmt::join(microphone.groups, "', '"), microphone.compact ? "compact" : "of each facet by itself",
                     microphone.viscous_stress ? "" : ", without viscous stress", mirrors, microphone.speed_of_sound);
}

/// What a reader of the file alone must know: units, what p is, of which medium, where.
io::SeriesWriter::Header header_of(const Case& config) {
  io::SeriesWriter::Header header = {
      {"case", config.name},
      {"units", "SI: times [s], instantaneous pressures [Pa], positions [m], speeds [m/s]"},
      {"pressure_Pa", "acoustic pressure, of the forces and masses that a surface of the flow gives off"},
      {"density_kg_m3", fmt::format("{}", config.fluid.density)}};
  for (const SurfaceMicrophoneSettings& microphone : config.surface_microphones) {
    const auto& [x, y, z] = microphone.position;
    header.emplace_back("position_m." + microphone.name, fmt::format("{} {} {}", x, y, z));
    header.emplace_back("microphone." + microphone.name, words(microphone));
  }
  return header;
}

}  // namespace

std::string surface_microphones_file(const Case& config) {
  return config.microphones.empty() ? "microphones.csv" : "microphones_of_surfaces.csv";
}

std::unique_ptr<io::SeriesWriter> open_surface_series(MPI_Comm comm, const Case& config, const std::string& folder,
                                                      double last, bool goes_on) {
  const std::string path = (std::filesystem::path(folder) / surface_microphones_file(config)).string();
  std::vector<std::string> columns = {"time_s"};
  for (const SurfaceMicrophoneSettings& microphone : config.surface_microphones) {
    columns.push_back("pressure_Pa." + microphone.name);
  }
  if (goes_on) return std::make_unique<io::SeriesWriter>(io::SeriesWriter::resume(comm, path, columns, 0, last));
  return std::make_unique<io::SeriesWriter>(comm, path, header_of(config), columns);
}

void write_surface_series(SurfaceMicrophones& microphones, io::SeriesWriter& series) {
  const SurfaceMicrophones::Block block = microphones.collect();
  const std::size_t count = microphones.microphones().size();
  for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
    std::vector<double> row = {block.times[sample]};
    row.insert(row.end(), block.values.begin() + static_cast<std::ptrdiff_t>(sample * count),
               block.values.begin() + static_cast<std::ptrdiff_t>((sample + 1) * count));
    series.write(row);
  }
}

}  // namespace vocalis::coupling
