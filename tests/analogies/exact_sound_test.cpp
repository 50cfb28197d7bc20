#include "tests/analogies/exact_sound.hpp"

#include <cmath>

using namespace vocalis::coupling::test;

namespace {

SourceWindow wide(const SpinningPair& pair) {
  return {0.25 * pair.wavelength(), pair.flow_radius() - 0.25 * pair.wavelength()};
}
SourceWindow close(const SpinningPair& pair) { return {5 * pair.orbit, pair.orbit}; }

}  // namespace

TEST_CASE("what analogies must make of two vortices is the formula at low Mach numbers, for cores as wide",
          "[serial]") {
  for (SpinningPair pair : {exadg(), trixi()}) {
    pair.speed_of_sound *= 32;  // M = 0.0016, 0.0035
    for (const Core core : {Core::scully, Core::gaussian}) {
      pair.core = core;
      const double factor = quadrupole_of_cores(pair);
      CHECK(std::abs(exact_at_rest(pair, "vortex", close(pair)) / factor - 1.0) < 1e-3);
      CHECK(std::abs(exact_at_rest(pair, "lighthill", close(pair)) / factor - 1.0) < 1e-3);
      CHECK(std::abs(exact_at_rest(pair, "pressure_rate", wide(pair)) - 1.0) < 1e-3);
      CHECK(std::abs(exact_at_rest(pair, "pcwe", wide(pair)) - 1.0) < 1e-3);
    }
  }
}

TEST_CASE("Lighthill's tensor and the rate of the pressure are one for narrow vortices, at any Mach number",
          "[serial]") {
  for (SpinningPair pair : {exadg(), trixi()}) {
    pair.core = Core::gaussian;
    pair.core_radius = 0.02 * pair.orbit;
    const auto of_tensor = exact_at_rest(pair, "lighthill", wide(pair));
    const auto of_pressure = exact_at_rest(pair, "pressure_rate", wide(pair));
    CAPTURE(of_tensor, of_pressure);
    CHECK(std::abs(of_tensor / of_pressure - 1.0) < 0.1 * std::pow(pair.mach_number(), 2) + 1e-3);
  }
}

TEST_CASE("the solution by elements is that by quadrature where the flow carries no sound", "[serial]") {
  for (const SpinningPair& pair : {exadg(), trixi()}) {
    for (const double elements : {1, 2}) {
      const auto pcwe = exact_in_flow(pair, "pcwe", wide(pair), false, elements);
      const auto ape = exact_in_flow(pair, "ape", close(pair), false, elements);
      CHECK(std::abs(pcwe / exact_at_rest(pair, "pcwe", wide(pair)) - 1.0) < 4e-3 / (elements * elements));
      CHECK(std::abs(ape / exact_at_rest(pair, "vortex", close(pair)) - 1.0) < 4e-3 / (elements * elements));
    }
    const auto coarse = exact_in_flow(pair, "pcwe", wide(pair)),
               fine = exact_in_flow(pair, "pcwe", wide(pair), true, 2);
    CHECK(std::abs(coarse / fine - 1.0) < 4e-3);
  }
}
