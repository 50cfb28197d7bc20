#include "acoustic_solver/signals/third_octaves.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace vocalis::acoustic;

namespace {

/// White noise of a density, with bins of a width, up to 22,050 Hz.
PowerSpectrum white(double density, double bin_width) {
  PowerSpectrum result;
  result.bin_width = bin_width;
  for (int bin = 0; bin * bin_width <= 22050; ++bin) {
    result.frequency.push_back(bin * bin_width);
    result.density.push_back(density);
  }
  return result;
}

double width(double middle) { return middle * (std::pow(10, 0.05) - std::pow(10, -0.05)); }

}  // namespace

TEST_CASE("each band of white noise holds its width times the density, whatever the bins", "[serial]") {
  for (const double bin_width : {1.0, 10.77}) {
    const auto bands = third_octaves(white(4e-10, bin_width));  // 0 dB re (20 uPa)^2/Hz
    REQUIRE(bands.size() == 20);
    CHECK(bands.front().nominal == 100);
    CHECK(bands.back().nominal == 8000);
    for (int i = 0; i < 20; ++i) {
      CHECK(bands[i].level == Approx(10 * std::log10(width(1000 * std::pow(10, (i - 10) / 10.0)))).epsilon(1e-12));
    }
  }
}

TEST_CASE("bands narrower than two bins are left out; silence has a level far below all sound", "[serial]") {
  const auto bands = third_octaves(white(0, 100));
  REQUIRE(!bands.empty());
  CHECK(bands.front().nominal == 1000);  // 231 Hz wide; the one below has 183 Hz
  for (const BandLevel& band : bands) CHECK(band.level == -300);
  CHECK(third_octaves({}).empty());
}

TEST_CASE("a tone is heard in its band alone", "[serial]") {
  std::vector<double> tone;
  for (int n = 0; n < 44100; ++n) tone.push_back(std::sqrt(2.0) * 0.02 * std::sin(2 * M_PI * 500.0 * n / 44100));
  const auto bands = third_octaves(welch(tone, 44100, 4096));
  for (const BandLevel& band : bands) {
    if (band.nominal == 500) {
      CHECK(band.level == Approx(60).margin(0.01));
    } else {
      CHECK(band.level < 20);
    }
  }
}
