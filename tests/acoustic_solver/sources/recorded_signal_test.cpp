#include "acoustic_solver/sources/recorded_signal.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/error.hpp"

using namespace vocalis::acoustic;
using Catch::Contains;

namespace {

constexpr double pi = std::numbers::pi;

/// Two periods of 100 Hz from 5 ms on, with samples that lie uneven.
RecordedSignal two_periods(double phase, double fade) {
  RecordedSignal signal{"made up", {}, {}, fade};
  for (int n = 0; n <= 200; ++n) {
    const double time = 0.02 * n / 200 + 2e-5 * std::sin(0.1 * pi * n);
    signal.times.push_back(0.005 + time);
    signal.values.push_back(3 * std::sin(2 * pi * 100 * time + phase));
  }
  return signal;
}

std::string message_of(const RecordedSignal& signal) {
  try {
    RecordedFlux{signal};
  } catch (const vocalis::base::UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("a recorded signal sounds from time 0 on and is silent before and after", "[serial]") {
  const RecordedFlux flux(two_periods(0, 0));
  CHECK(flux.end() == Approx(0.02));
  CHECK(flux.value(-1e-4) == 0);
  CHECK(flux.value(0.0201) == 0);
  for (int n = 1; n < 100; ++n) {
    const double time = 0.02 * n / 100;
    CHECK(flux.value(time) == Approx(3 * std::sin(2 * pi * 100 * time)).margin(2e-6));
    CHECK(flux.rate(time) == Approx(3 * 2 * pi * 100 * std::cos(2 * pi * 100 * time)).margin(0.1));
  }
}

TEST_CASE("a signal with a fade begins and ends at rest, and its rate is that of its values", "[serial]") {
  const RecordedFlux flux(two_periods(0.5 * pi, 0.003));
  CHECK(flux.value(1e-9) == Approx(0).margin(1e-9));
  CHECK(flux.rate(1e-9) == Approx(0).margin(0.02));
  CHECK(flux.value(0.02 - 1e-9) == Approx(0).margin(1e-9));
  CHECK(flux.value(0.0015) == Approx(1.5 * std::cos(2 * pi * 0.15)).epsilon(1e-5));
  for (const double time : {0.0007, 0.0029, 0.0031, 0.01, 0.0169, 0.0171, 0.0195}) {
    const double difference = (flux.value(time + 1e-7) - flux.value(time - 1e-7)) / 2e-7;
    CHECK(flux.rate(time) == Approx(difference).epsilon(1e-5).margin(1e-3));
  }
}

TEST_CASE("the derivative of a recorded signal has no steps at its samples", "[serial]") {
  const RecordedSignal signal = two_periods(0, 0);
  const RecordedFlux flux(signal);
  for (std::size_t n = 1; n + 1 < signal.times.size(); ++n) {
    const double time = signal.times[n] - signal.times[0];
    CHECK(flux.rate(time + 1e-12) == Approx(flux.rate(time - 1e-12)).margin(1e-3));
  }
}

TEST_CASE("signals that cannot be a source are refused with a remedy", "[serial]") {
  const RecordedSignal sound = two_periods(0, 0);
  CHECK(message_of(sound) == "no error");
  RecordedSignal wrong = sound;
  wrong.times[7] = wrong.times[6];
  CHECK_THAT(message_of(wrong), Contains("must increase") && Contains("sample 8"));
  wrong = sound;
  wrong.values[3] = std::nan("");
  CHECK_THAT(message_of(wrong), Contains("finite") && Contains("sample 4"));
  wrong = sound;
  wrong.values.assign(wrong.values.size(), 0.0);
  CHECK_THAT(message_of(wrong), Contains("silent"));
  CHECK_THAT(message_of({"x", {0, 1, 2}, {0, 1, 0}, 0}), Contains("at least four samples"));
  CHECK_THAT(message_of(two_periods(1, 0)), Contains("needs a fade"));
  CHECK(message_of(two_periods(1, 0.001)) == "no error");
  CHECK_THAT(message_of(two_periods(1, 0.011)), Contains("half of the signal"));
}
