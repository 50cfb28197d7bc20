#include "coupling/sound/spectra_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"

namespace vocalis::coupling {

namespace {

/// The value at a frequency of equally spaced levels, straight between bins; not a number where there is none.
double level_at(const std::vector<double>& frequency, const std::vector<double>& level, double wanted) {
  if (frequency.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  const double bin = frequency[1] - frequency[0];
  const auto below = static_cast<std::size_t>(wanted / bin);
  if (below + 1 >= level.size()) return std::numeric_limits<double>::quiet_NaN();
  const double part = wanted / bin - static_cast<double>(below);
  return (1 - part) * level[below] + part * level[below + 1];
}

void close(std::ofstream& file, const std::string& path) {
  file.close();
  if (!file) throw base::UserError("the spectra must be writable", path, "check the folder's rights and free space");
}

}  // namespace

void write_spectra(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds) {
  constexpr double highest = 10000;  // [Hz]
  const bool has_transfer = !sounds.empty() && !sounds.front().analysis.transfer_frequency.empty();
  std::ofstream file(path);
  file << "# case: " << config.name << "\n# psd: Welch, Hann window, half overlap, dB re (20e-6 Pa)^2/Hz\n";
  if (has_transfer) file << "# transfer: microphone pressure over the source (pulse [m/s] or volume flow), dB re 1\n";
  if (!sounds.empty()) {
    const acoustic::PowerSpectrum& first = sounds.front().analysis.power;
    file << fmt::format("# bin_width_Hz: {}\n# noise_bandwidth_Hz: {}\n# segments: {}\n", first.bin_width,
                        first.noise_bandwidth, first.segments);
  }
  file << "frequency_Hz";
  std::vector<std::vector<double>> levels;
  for (const ChannelSound& sound : sounds) {
    file << ",psd_dB." << sound.channel.suffix;
    if (has_transfer) file << ",transfer_dB." << sound.channel.suffix;
    levels.push_back(acoustic::density_level(sound.analysis.power));
  }
  file << '\n';
  // The transfer function has the finer bins, where there is one. A record too short for a spectrum has no rows.
  const double bin = sounds.empty() ? 0
                     : has_transfer ? sounds.front().analysis.transfer_frequency[1]
                                    : sounds.front().analysis.power.bin_width;
  for (int row = 0; bin > 0 && row * bin <= highest; ++row) {
    const double frequency = row * bin;
    file << fmt::format("{:.6g}", frequency);
    for (std::size_t i = 0; i < sounds.size(); ++i) {
      const SoundAnalysis& analysis = sounds[i].analysis;
      file << fmt::format(",{:.4f}", level_at(analysis.power.frequency, levels[i], frequency));
      if (has_transfer) {
        file << fmt::format(",{:.4f}", level_at(analysis.transfer_frequency, analysis.transfer_level, frequency));
      }
    }
    file << '\n';
  }
  close(file, path);
}

void write_harmonics(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds) {
  std::ofstream file(path);
  file << "# case: " << config.name << "\n# level: of the harmonic's rms, dB re 20e-6 Pa\nharmonic";
  std::size_t rows = 0;
  for (const ChannelSound& sound : sounds) {
    if (sound.analysis.harmonics.empty()) continue;
    file << ",frequency_Hz." << sound.channel.suffix << ",level_dB." << sound.channel.suffix;
    rows = std::max(rows, sound.analysis.harmonics.size());
  }
  file << '\n';
  for (std::size_t row = 0; row < rows; ++row) {
    file << row + 1;
    for (const ChannelSound& sound : sounds) {
      const auto& harmonics = sound.analysis.harmonics;
      if (harmonics.empty()) continue;
      const bool there = row < harmonics.size();
      file << (there ? fmt::format(",{:.6g},{:.4f}", harmonics[row].frequency, harmonics[row].level) : ",nan,nan");
    }
    file << '\n';
  }
  close(file, path);
}

}  // namespace vocalis::coupling
