#include "coupling/sound/sound_comparison.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "core/io/series_reader.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// A tone of 0.2 s at 500 Hz.
ChannelSound tone(const std::string& solver, const std::string& microphone, double amplitude) {
  std::vector<double> sound;
  for (int n = 0; n < 8820; ++n) sound.push_back(amplitude * std::sin(2 * M_PI * 500 * n / 44100.0));
  return {{.suffix = solver + "." + microphone, .column = "", .solver = solver, .microphone = microphone, .file = ""},
          analyse_sound(sound, {}, 44100, 0, 500)};
}

double row_of(const SoundComparison& comparison, double band, std::size_t other) {
  for (const auto& row : comparison.rows) {
    if (row.band == band) return row.difference.at(other);
  }
  return NAN;
}

}  // namespace

TEST_CASE("solvers are held against the first one at each microphone", "[serial]") {
  const std::vector<ChannelSound> sounds = {tone("one", "near", 1),   tone("one", "far", 0.1),
                                            tone("two", "near", 2),   tone("two", "far", 0.05),
                                            tone("three", "near", 0), tone("three", "far", 1)};
  const auto comparisons = compare_sounds(sounds);
  REQUIRE(comparisons.size() == 2);
  CHECK(comparisons[0].microphone == "near");
  CHECK(comparisons[1].microphone == "far");
  CHECK(comparisons[0].solvers == std::vector<std::string>{"one", "two", "three"});
  CHECK(comparisons[0].rows[0].level == Approx(20 * std::log10(std::sqrt(0.5) / 20e-6)).epsilon(1e-6));
  for (const double band : {0.0, 500.0}) {  // of all, and in its own third of an octave
    CHECK(row_of(comparisons[0], band, 0) == Approx(20 * std::log10(2)).epsilon(1e-6));
    CHECK(row_of(comparisons[1], band, 0) == Approx(-20 * std::log10(2)).epsilon(1e-6));
    CHECK(std::isnan(row_of(comparisons[0], band, 1)));  // silence is not so and so many dB below
    CHECK(row_of(comparisons[1], band, 1) == Approx(20).epsilon(1e-6));
  }
}

TEST_CASE("one solver alone is held against nothing", "[serial]") {
  CHECK(compare_sounds({tone("one", "near", 1), tone("one", "far", 1)}).empty());
  CHECK(compare_sounds({}).empty());
}

TEST_CASE("the file of third octaves has a column for each solver and microphone", "[serial]") {
  const std::string path = (std::filesystem::temp_directory_path() / "vocalis_third_octaves.csv").string();
  write_third_octaves(path, {}, {tone("one", "near", 1), tone("two", "near", 2)});
  const io::Series series = io::read_series(path);
  std::remove(path.c_str());
  REQUIRE(series.find("band_Hz"));
  const auto& bands = *series.find("band_Hz");
  const auto row = std::find(bands.begin(), bands.end(), 500) - bands.begin();
  CHECK((*series.find("level_dB.two.near"))[row] - (*series.find("level_dB.one.near"))[row] ==
        Approx(20 * std::log10(2)).epsilon(1e-3));
}
