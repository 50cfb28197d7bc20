#include "acoustic_solver/signals/resample.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

using namespace vocalis::acoustic;

namespace {

double tone(double frequency, double time) { return std::sin(2 * std::numbers::pi * frequency * time + 0.4); }

std::vector<double> sampled_tone(double frequency, double rate, int count) {
  std::vector<double> values;
  for (int n = 0; n < count; ++n) values.push_back(tone(frequency, n / rate));
  return values;
}

/// Largest deviation from the tone away from the ends, where the record is continued by guesswork.
double largest_error(const std::vector<double>& values, double rate, double frequency, double gain = 1) {
  double error = 0;
  const auto count = static_cast<int>(values.size());
  for (int n = count / 5; n < count - count / 5; ++n) {
    error = std::max(error, std::abs(values[static_cast<std::size_t>(n)] - gain * tone(frequency, n / rate)));
  }
  return error;
}

}  // namespace

TEST_CASE("tones in the pass band keep amplitude and phase", "[serial]") {
  for (double frequency : {100.0, 1000.0, 5000.0, 12000.0, 19800.0}) {
    const auto down = resample(sampled_tone(frequency, 100000, 4000), 100000, 44100);
    CHECK(down.size() == 1764);  // floor(3999 * 0.441) + 1
    CHECK(largest_error(down, 44100, frequency) < 2e-5);
  }
  CHECK(largest_error(resample(sampled_tone(4000, 10000, 1000), 10000, 44100), 44100, 4000) < 2e-5);
  CHECK(largest_error(resample(sampled_tone(300, 44100, 2000), 44100, 44100), 44100, 300) < 2e-5);
}

TEST_CASE("tones above the new Nyquist frequency are rejected by more than 80 dB", "[serial]") {
  for (double frequency : {22100.0, 24000.0, 30000.0, 43900.0, 49000.0}) {
    const auto down = resample(sampled_tone(frequency, 100000, 4000), 100000, 44100);
    CHECK(largest_error(down, 44100, frequency, 0) < 1e-4);
  }
}

TEST_CASE("images of a tone are rejected when the rate rises", "[serial]") {
  // 1 kHz of 10 kHz has images at 9 and 11 kHz; what is left beside the tone is the error above.
  CHECK(largest_error(resample(sampled_tone(1000, 10000, 2000), 10000, 100000), 100000, 1000) < 1e-4);
}

TEST_CASE("unequal steps are taken to a uniform rate", "[serial]") {
  // Steps between 0.5e-5 and 1.5e-5 s, as sub-steps and adaptive steps give them.
  std::vector<double> times{0.25};
  while (times.back() < 0.30) {
    const double k = static_cast<double>(times.size());
    times.push_back(times.back() + 1e-5 * (1 + 0.5 * std::sin(0.7 * k)));
  }
  for (double frequency : {100.0, 1000.0, 5000.0}) {
    std::vector<double> values;
    for (double time : times) values.push_back(tone(frequency, time - 0.25));
    const auto uniform = resample(times, values, 44100);
    CHECK(largest_error(uniform, 44100, frequency) < 1e-3);
  }
}

TEST_CASE("equal time stamps give what the rate gives", "[serial]") {
  const auto values = sampled_tone(700, 50000, 500);
  std::vector<double> times;
  for (int n = 0; n < 500; ++n) times.push_back(1.5 + n / 50000.0);
  const auto by_rate = resample(values, 50000, 44100);
  const auto by_time = resample(times, values, 44100);
  REQUIRE(by_rate.size() == by_time.size());
  for (std::size_t n = 0; n < by_rate.size(); ++n) CHECK(by_time[n] == Approx(by_rate[n]).margin(1e-7));
}

TEST_CASE("a straight line stays one up to its ends", "[serial]") {
  std::vector<double> values;
  for (int n = 0; n < 300; ++n) values.push_back(2 + 0.01 * n);
  const auto line = resample(values, 96000, 44100);
  for (std::size_t n = 0; n < line.size(); ++n) {
    CHECK(line[n] == Approx(2 + 0.01 * static_cast<double>(n) * 96000 / 44100).margin(2e-4));
  }
}

TEST_CASE("the spline is exact for a cubic", "[serial]") {
  const auto cubic = [](double t) { return 1 - 2 * t + 0.5 * t * t + 3 * t * t * t; };
  std::vector<double> times{0, 0.1, 0.15, 0.4, 0.7, 0.75, 1};
  std::vector<double> values;
  for (double time : times) values.push_back(cubic(time));
  const auto result = spline_to_uniform(times, values, 0.04, 26);
  for (int k = 0; k < 26; ++k) CHECK(result[static_cast<std::size_t>(k)] == Approx(cubic(0.04 * k)).epsilon(1e-10));
}

TEST_CASE("time must increase", "[serial]") {
  const std::vector<double> times{0, 1e-5, 1e-5, 2e-5};
  const std::vector<double> values{0, 1, 1, 2};
  CHECK_THROWS_AS(resample(times, values, 44100), vocalis::base::UserError);
  CHECK(resample(std::vector<double>{}, std::vector<double>{}, 44100).empty());
}
