#include "core/io/wav.hpp"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "core/base/error.hpp"

using namespace vocalis::io;

namespace {

std::string scratch_file(const char* name) {
  return (std::filesystem::temp_directory_path() / (std::to_string(getpid()) + name)).string();
}

std::vector<double> tone() {
  std::vector<double> pressure;
  for (int n = 0; n < 500; ++n) pressure.push_back(2.5 * std::sin(0.05 * n));
  return pressure;
}

}  // namespace

TEST_CASE("a float sound file gives the pascals back, above full scale too", "[serial]") {
  const std::string path = scratch_file("_float.wav");
  const auto pressure = tone();
  CHECK(write_wav(path, pressure, {44100, WavSettings::Format::float32, 0.5}) == 0.5);
  const Sound sound = read_wav(path);
  std::remove(path.c_str());
  CHECK(sound.sampling_rate == 44100);
  CHECK(sound.comment == "sample 1.0 is 0.5 Pa");
  REQUIRE(sound.pressure.size() == pressure.size());
  for (std::size_t n = 0; n < pressure.size(); ++n) {
    CHECK(sound.pressure[n] == Approx(pressure[n]).epsilon(1e-7).margin(1e-9));
  }
}

TEST_CASE("a 16 bit sound file fills its range and says what 1.0 means", "[serial]") {
  const std::string path = scratch_file("_int.wav");
  auto pressure = tone();
  for (double& value : pressure) value *= 1e-6;
  const double full_scale = write_wav(path, pressure, {44100, WavSettings::Format::int16, 1});
  const Sound sound = read_wav(path);
  std::remove(path.c_str());
  CHECK(full_scale > 2.4e-6);
  CHECK(full_scale < 3.2e-6);
  REQUIRE(sound.pressure.size() == pressure.size());
  // Half a step of rounding, and up to one because libsndfile writes with 32767 and reads with 32768.
  for (std::size_t n = 0; n < pressure.size(); ++n) {
    CHECK(std::abs(sound.pressure[n] - pressure[n]) < 1.5 * full_scale / 32768);
  }
}

TEST_CASE("the same sound gives the same bytes", "[serial]") {
  const std::string first = scratch_file("_a.wav");
  const std::string second = scratch_file("_b.wav");
  write_wav(first, tone());
  sleep(1);  // a date in the file would have a resolution of a second
  write_wav(second, tone());
  const auto bytes = [](const std::string& path) {
    std::string content;
    if (FILE* file = std::fopen(path.c_str(), "rb")) {
      for (int c = std::fgetc(file); c != EOF; c = std::fgetc(file)) content.push_back(static_cast<char>(c));
      std::fclose(file);
    }
    return content;
  };
  CHECK(bytes(first).size() > 2000);
  CHECK(bytes(first) == bytes(second));
  std::remove(first.c_str());
  std::remove(second.c_str());
}

TEST_CASE("sound files that cannot be written or read are the user's to mend", "[serial]") {
  using vocalis::base::UserError;
  CHECK_THROWS_AS(write_wav("/nowhere/at/all.wav", tone()), UserError);
  CHECK_THROWS_AS(read_wav("/nowhere/at/all.wav"), UserError);
  const std::vector<double> diverged{0.0, std::numeric_limits<double>::quiet_NaN()};
  CHECK_THROWS_AS(write_wav(scratch_file("_nan.wav"), diverged), UserError);
  CHECK_THROWS_AS(write_wav(scratch_file("_zero.wav"), tone(), {44100, WavSettings::Format::float32, 0}), UserError);
}
