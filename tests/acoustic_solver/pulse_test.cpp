#include "acoustic_solver/pulse.hpp"

#include <catch2/catch.hpp>

using namespace vocalis::acoustic;

TEST_CASE("a pulse flux is whichever kind was set", "[serial]") {
  const PulseFlux gaussian(GaussianPulse{1e-4, 10000});
  const GaussianFlux same(GaussianPulse{1e-4, 10000});
  CHECK(gaussian.value(2e-4) == same.value(2e-4));
  CHECK(gaussian.rate(1e-4) == same.rate(1e-4));
  const PulseFlux voiced(LiljencrantsFantPulse{});
  CHECK(voiced.rate(0.006) == Approx(-0.4));
  const PulseFlux trigonometric(RosenbergPulse{.fundamental_frequency = 100, .amplitude = 2});
  CHECK(trigonometric.value(0.004) == Approx(2));
  const PulseFlux recorded(RecordedSignal{"made up", {0, 1, 2, 3, 4}, {0, 0, 7, 0, 0}, 0});
  CHECK(recorded.value(2) == Approx(7));
}

TEST_CASE("voiced pulses know their pitch; a single pulse has none, and a signal does not know it", "[serial]") {
  CHECK(prescribed_pitch(LiljencrantsFantPulse{.fundamental_frequency = 731}) == 731);
  CHECK(prescribed_pitch(RosenbergPulse{.fundamental_frequency = 42}) == 42);
  CHECK(!prescribed_pitch(GaussianPulse{}));
  CHECK(!prescribed_pitch(RecordedSignal{"made up", {0, 1, 2, 3, 4}, {0, 0, 7, 0, 0}, 0}));
}
