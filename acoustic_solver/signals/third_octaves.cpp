#include "acoustic_solver/signals/third_octaves.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::acoustic {

namespace {

constexpr double nominal[] = {100,  125,  160,  200,  250,  315,  400,  500,  630,  800,
                              1000, 1250, 1600, 2000, 2500, 3150, 4000, 5000, 6300, 8000};
constexpr int band_of_1000 = 10;

/// Integral of a density that is constant in each bin, from half a bin below its frequency to half a bin above.
double power_between(const PowerSpectrum& spectrum, double low, double high) {
  const double width = spectrum.bin_width;
  double power = 0;
  for (auto bin = static_cast<std::size_t>(low / width); bin < spectrum.density.size(); ++bin) {
    const double begin = std::max(low, spectrum.frequency[bin] - width / 2);
    const double end = std::min(high, spectrum.frequency[bin] + width / 2);
    if (begin >= high) break;
    power += spectrum.density[bin] * std::max(0.0, end - begin);
  }
  return power;
}

}  // namespace

std::vector<BandLevel> third_octaves(const PowerSpectrum& pressure) {
  std::vector<BandLevel> result;
  if (pressure.density.empty()) return result;
  for (int i = 0; i < static_cast<int>(std::size(nominal)); ++i) {
    const double middle = 1000 * std::pow(10, (i - band_of_1000) / 10.0), edge = std::pow(10, 1 / 20.0);
    const double low = middle / edge, high = middle * edge;
    if (high - low < 2 * pressure.bin_width || high > pressure.frequency.back()) continue;
    const double power = power_between(pressure, low, high) / (reference_pressure * reference_pressure);
    result.push_back({nominal[i], power > 1e-30 ? 10 * std::log10(power) : -300});
  }
  return result;
}

}  // namespace vocalis::acoustic
