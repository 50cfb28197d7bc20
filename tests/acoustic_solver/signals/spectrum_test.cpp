#include "acoustic_solver/signals/spectrum.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

using namespace vocalis::acoustic;

namespace {

/// The formula whose spectra were computed with scipy 1.10.1: welch(x, 8000, nperseg=...).
std::vector<double> formula_x() {
  std::vector<double> x;
  for (int n = 0; n < 1000; ++n) x.push_back(0.3 + std::sin(0.37 * n) + 0.5 * std::cos(0.002 * n * n) + 0.001 * n);
  return x;
}

}  // namespace

TEST_CASE("welch agrees with SciPy for an even segment", "[serial]") {
  const PowerSpectrum spectrum = welch(formula_x(), 8000, 256);
  REQUIRE(spectrum.density.size() == 129);
  CHECK(spectrum.segments == 6);
  CHECK(spectrum.bin_width == Approx(31.25));
  CHECK(spectrum.noise_bandwidth == Approx(1.5 * 31.25));
  CHECK(spectrum.frequency[100] == Approx(3125.0));
  CHECK(spectrum.density[0] == Approx(3.186861176490805e-06).epsilon(1e-9));
  CHECK(spectrum.density[1] == Approx(4.1778665855346336e-05).epsilon(1e-9));
  CHECK(spectrum.density[15] == Approx(0.010323039908295903).epsilon(1e-9));
  CHECK(spectrum.density[40] == Approx(4.1202174012569825e-05).epsilon(1e-9));
  CHECK(spectrum.density[100] == Approx(3.485788028408237e-05).epsilon(1e-9));
  CHECK(spectrum.density[128] == Approx(1.1889467765208503e-06).epsilon(1e-9));
}

TEST_CASE("welch agrees with SciPy for an odd segment and for one longer than the series", "[serial]") {
  const PowerSpectrum odd = welch(formula_x(), 8000, 255);
  REQUIRE(odd.density.size() == 128);
  CHECK(odd.density[0] == Approx(2.9983012777714183e-06).epsilon(1e-9));
  CHECK(odd.density[15] == Approx(0.010370271035199325).epsilon(1e-9));
  CHECK(odd.density[127] == Approx(1.7420906075653148e-06).epsilon(1e-9));
  const PowerSpectrum whole = welch(formula_x(), 8000, 4096);
  REQUIRE(whole.density.size() == 501);
  CHECK(whole.segments == 1);
  CHECK(whole.density[15] == Approx(2.496207339588965e-09).epsilon(1e-6));
}

TEST_CASE("the sum of a density over its bins is the variance", "[serial]") {
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(3.0, 0.02);
  std::vector<double> series(1 << 16);
  for (double& value : series) value = noise(generator);
  const PowerSpectrum spectrum = welch(series, 44100, 2048);
  double power = 0;
  for (double density : spectrum.density) power += density * spectrum.bin_width;
  CHECK(power == Approx(0.02 * 0.02).epsilon(0.02));  // 63 segments of 1025 bins: well below 2 %
  // White noise: 2 variance / rate in every bin.
  const double expected = 10 * std::log10(2 * 0.02 * 0.02 / 44100 / (20e-6 * 20e-6));
  double mean = 0;
  for (double level : density_level(spectrum)) mean += level / 1025;
  CHECK(mean == Approx(expected).margin(0.15));  // the mean of logarithms lies a little lower
}

TEST_CASE("a line of 1 Pa amplitude has 90.97 dB whatever the constant pressure", "[serial]") {
  std::vector<double> pressure(44100);
  for (std::size_t n = 0; n < pressure.size(); ++n) {
    pressure[n] = 1000 + std::cos(2 * std::numbers::pi * 100 * static_cast<double>(n) / 44100);
  }
  CHECK(sound_pressure_level(pressure) == Approx(20 * std::log10(1 / std::sqrt(2.0) / 20e-6)).margin(1e-6));
  CHECK(sound_pressure_level(std::vector<double>(10, 5.0)) == -300);
  CHECK(sound_pressure_level({}) == -300);
}

TEST_CASE("the transfer function of a transient is that of the system, with fine bins", "[serial]") {
  // First order low pass y_n = 0.9 y_{n-1} + 0.1 x_n: H = 0.1 / (1 - 0.9 e^{-i w dt}); 0.9^600 = 1e-28 is left out.
  std::vector<double> source(700, 0.0);
  std::vector<double> response(700, 0.0);
  for (int n = 0; n < 20; ++n) source[static_cast<std::size_t>(n)] = std::exp(-0.5 * std::pow((n - 8) / 1.6, 2));
  for (std::size_t n = 0; n < 700; ++n) response[n] = (n > 0 ? 0.9 * response[n - 1] : 0.0) + 0.1 * source[n];
  const ComplexSpectrum h = transient_transfer_function(source, response, 10000, 2.0);
  REQUIRE(h.frequency[1] <= 2.0);
  bool undefined = false;
  for (std::size_t k = 0; k < h.value.size(); ++k) {
    if (std::isnan(h.value[k].real())) {
      undefined = true;
      continue;
    }
    const auto turn = std::polar(0.9, -2 * std::numbers::pi * h.frequency[k] / 10000);
    CHECK(std::abs(h.value[k] - 0.1 / (1.0 - turn)) < 1e-9);
  }
  CHECK(undefined);  // at half the sampling rate the pulse has only exp(-0.5 (1.6 pi)^2) = 3e-6 of its largest value
}
