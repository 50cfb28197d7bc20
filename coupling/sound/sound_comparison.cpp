#include "coupling/sound/sound_comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"

namespace vocalis::coupling {

namespace {

constexpr double silence = -200;  // [dB] what is not above it is no sound

double above(double level, double first) {
  return level > silence && first > silence ? level - first : std::numeric_limits<double>::quiet_NaN();
}

SoundComparison compare(const std::vector<const ChannelSound*>& sounds) {
  const SoundAnalysis& first = sounds.front()->analysis;
  SoundComparison result = {.microphone = sounds.front()->channel.microphone, .solvers = {}, .rows = {}};
  result.rows.push_back({.band = 0, .level = first.level, .difference = {}});
  for (const acoustic::BandLevel& band : acoustic::third_octaves(first.power)) {
    result.rows.push_back({.band = band.nominal, .level = band.level, .difference = {}});
  }
  for (const ChannelSound* sound : sounds) {
    result.solvers.push_back(sound->channel.solver);
    if (sound == sounds.front()) continue;
    // All microphones were recorded for the same time but for a step, so they have the same bands.
    const auto bands = acoustic::third_octaves(sound->analysis.power);
    result.rows[0].difference.push_back(above(sound->analysis.level, first.level));
    for (std::size_t i = 1; i < result.rows.size(); ++i) {
      const double level = i <= bands.size() ? bands[i - 1].level : silence;
      result.rows[i].difference.push_back(above(level, result.rows[i].level));
    }
  }
  return result;
}

/// A number in a field of a solver's column, or a dash where there is none.
std::string field(double value, std::size_t width, bool with_sign) {
  if (!std::isfinite(value) || value <= silence) return fmt::format("{:>{}}", "-", width);
  const double shown = std::round(10 * value) / 10 + 0.0;  // no zero below zero
  return with_sign ? fmt::format("{:>+{}.1f}", shown, width) : fmt::format("{:>{}.1f}", shown, width);
}

}  // namespace

std::vector<SoundComparison> compare_sounds(const std::vector<ChannelSound>& sounds) {
  std::vector<SoundComparison> result;
  for (const ChannelSound& first : sounds) {
    if (first.channel.solver != sounds.front().channel.solver) continue;
    std::vector<const ChannelSound*> same;
    for (const ChannelSound& sound : sounds) {
      if (sound.channel.microphone == first.channel.microphone) same.push_back(&sound);
    }
    if (same.size() > 1) result.push_back(compare(same));
  }
  return result;
}

void print_comparisons(base::Log& log, const std::vector<SoundComparison>& comparisons) {
  for (const SoundComparison& comparison : comparisons) {
    log.info("microphone {}: {} [dB re 20 uPa], and what the others have above it [dB], by thirds of an octave",
             comparison.microphone, comparison.solvers.front());
    std::string line = "   band [Hz]";
    std::vector<std::size_t> widths;
    for (const std::string& solver : comparison.solvers) {
      widths.push_back(std::max<std::size_t>(10, solver.size() + 2));
      line += fmt::format("{:>{}}", solver, widths.back());
    }
    log.info("{}", line);
    for (const SoundComparison::Row& row : comparison.rows) {
      line = row.band > 0 ? fmt::format("{:>12.0f}", row.band) : "         all";
      line += field(row.level, widths[0], false);
      for (std::size_t i = 0; i < row.difference.size(); ++i) line += field(row.difference[i], widths[i + 1], true);
      log.info("{}", line);
    }
    log.info("");
  }
}

void write_third_octaves(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds) {
  std::ofstream file(path);
  file << "# case: " << config.name
       << "\n# level: of a third of an octave by its nominal frequency (IEC 61260-1), dB re 20e-6 Pa\n# solvers: ";
  for (std::size_t i = 0; i < config.acoustics.size(); ++i) file << (i > 0 ? ", " : "") << config.acoustics[i].name;
  file << "\nband_Hz";
  std::vector<std::vector<acoustic::BandLevel>> columns;
  for (const ChannelSound& sound : sounds) {
    file << ",level_dB." << sound.channel.suffix;
    columns.push_back(acoustic::third_octaves(sound.analysis.power));
  }
  file << '\n';
  for (std::size_t row = 0; !columns.empty() && row < columns.front().size(); ++row) {
    file << fmt::format("{:.0f}", columns.front()[row].nominal);
    for (const auto& column : columns) file << fmt::format(",{:.4f}", column[row].level);
    file << '\n';
  }
  file.close();
  if (!file) throw base::UserError("the spectra must be writable", path, "check the folder's rights and free space");
}

}  // namespace vocalis::coupling
