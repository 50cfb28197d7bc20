#include "coupling/spectra_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "core/base/error.hpp"

namespace vocalis::coupling {

namespace {

/// The value at a frequency of equally spaced levels, straight between bins.
double level_at(const std::vector<double>& frequency, const std::vector<double>& level, double wanted) {
  const double bin = frequency[1] - frequency[0];
  const auto below = static_cast<std::size_t>(wanted / bin);
  if (below + 1 >= level.size()) return std::numeric_limits<double>::quiet_NaN();
  const double part = wanted / bin - static_cast<double>(below);
  return (1 - part) * level[below] + part * level[below + 1];
}

}  // namespace

void write_spectra(const std::string& path, const Case& config, const std::vector<ChannelSpectrum>& spectra) {
  constexpr double highest = 10000;  // [Hz]
  std::ofstream file(path);
  file << "# case: " << config.name << "\n# psd: Welch, Hann window, half overlap, dB re (20e-6 Pa)^2/Hz\n";
  if (config.source) file << "# transfer: microphone pressure over source velocity, dB re 1 Pa s/m\n";
  if (!spectra.empty()) {
    const acoustic::PowerSpectrum& first = spectra.front().power;
    file << fmt::format("# bin_width_Hz: {}\n# noise_bandwidth_Hz: {}\n# segments: {}\n", first.bin_width,
                        first.noise_bandwidth, first.segments);
  }
  file << "frequency_Hz";
  std::vector<std::vector<double>> levels, transfers;
  for (const ChannelSpectrum& spectrum : spectra) {
    file << ",psd_dB." << spectrum.channel.suffix;
    if (config.source) file << ",transfer_dB." << spectrum.channel.suffix;
    levels.push_back(acoustic::density_level(spectrum.power));
    transfers.push_back(acoustic::magnitude_level(spectrum.transfer));
  }
  file << '\n';
  // The transfer function has the finer bins, where there is one.
  const auto& rows = config.source && !spectra.empty() ? spectra.front().transfer.frequency
                     : spectra.empty()                 ? std::vector<double>{}
                                                       : spectra.front().power.frequency;
  for (const double frequency : rows) {
    if (frequency > highest) break;
    file << fmt::format("{:.6g}", frequency);
    for (std::size_t i = 0; i < spectra.size(); ++i) {
      file << fmt::format(",{:.4f}", level_at(spectra[i].power.frequency, levels[i], frequency));
      if (config.source) {
        file << fmt::format(",{:.4f}", level_at(spectra[i].transfer.frequency, transfers[i], frequency));
      }
    }
    file << '\n';
  }
  file.close();
  if (!file) throw base::UserError("the spectra must be writable", path, "check the folder's rights and free space");
}

}  // namespace vocalis::coupling
