#include "coupling/spectra_file.hpp"

#include <fmt/format.h>

#include <cmath>
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

}  // namespace

void write_spectra(const std::string& path, const Case& config, const std::vector<ChannelSpectrum>& spectra) {
  constexpr double highest = 10000;  // [Hz]
  const bool has_transfer = !spectra.empty() && !spectra.front().transfer_frequency.empty();
  std::ofstream file(path);
  file << "# case: " << config.name << "\n# psd: Welch, Hann window, half overlap, dB re (20e-6 Pa)^2/Hz\n";
  if (has_transfer) file << "# transfer: microphone pressure over the source (pulse [m/s] or volume flow), dB re 1\n";
  if (!spectra.empty()) {
    const acoustic::PowerSpectrum& first = spectra.front().power;
    file << fmt::format("# bin_width_Hz: {}\n# noise_bandwidth_Hz: {}\n# segments: {}\n", first.bin_width,
                        first.noise_bandwidth, first.segments);
  }
  file << "frequency_Hz";
  std::vector<std::vector<double>> levels;
  for (const ChannelSpectrum& spectrum : spectra) {
    file << ",psd_dB." << spectrum.channel.suffix;
    if (has_transfer) file << ",transfer_dB." << spectrum.channel.suffix;
    levels.push_back(acoustic::density_level(spectrum.power));
  }
  file << '\n';
  // The transfer function has the finer bins, where there is one. A record too short for a spectrum has no rows.
  const double bin = spectra.empty() ? 0
                     : has_transfer  ? spectra.front().transfer_frequency[1]
                                     : spectra.front().power.bin_width;
  for (int row = 0; bin > 0 && row * bin <= highest; ++row) {
    const double frequency = row * bin;
    file << fmt::format("{:.6g}", frequency);
    for (std::size_t i = 0; i < spectra.size(); ++i) {
      file << fmt::format(",{:.4f}", level_at(spectra[i].power.frequency, levels[i], frequency));
      if (has_transfer) {
        file << fmt::format(",{:.4f}", level_at(spectra[i].transfer_frequency, spectra[i].transfer_level, frequency));
      }
    }
    file << '\n';
  }
  file.close();
  if (!file) throw base::UserError("the spectra must be writable", path, "check the folder's rights and free space");
}

}  // namespace vocalis::coupling
