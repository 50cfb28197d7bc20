#include <cmath>
#include <cstdio>

#include "core/base/mpi.hpp"
#include "tests/analogies/hear_pair.hpp"

using namespace vocalis;
using namespace vocalis::coupling::test;

namespace {

/// Within 5 % and 5 degrees of the formula, for cores as wide as these.
void check_against_formula(const SpinningPair& pair, const Heard& heard) {
  const double expected = needs_near_field(heard.model.analogy) ? 1 : quadrupole_of_cores(pair);
  CAPTURE(heard.model.analogy, heard.wave, expected);
  CHECK(std::abs(std::abs(heard.wave) / expected - 1) < 0.05);
  CHECK(std::abs(degrees(heard.wave)) < 5);
}

/// Within 2 % and 3 degrees of what the analogy itself must give.
void check_against_exact(const Heard& heard) {
  CAPTURE(heard.model.analogy, heard.wave, heard.exact);
  CHECK(std::abs(std::abs(heard.wave / heard.exact) - 1) < 0.02);
  CHECK(std::abs(degrees(heard.wave / heard.exact)) < 3);
}

}  // namespace

TEST_CASE("two vortices that spin sound as each analogy must: within 2 % and 3 degrees of its own solution",
          "[serial]") {
  const std::vector<Model> all = {{"pressure_rate"}, {"pcwe"}, {"ape"}, {"lighthill"}, {"vortex"}};
  const auto is_in_formula = [](const SpinningPair& pair, const std::string& analogy) {
    return analogy == "vortex" || (pair.mach_number() < 0.06 && (analogy == "pressure_rate" || analogy == "lighthill"));
  };
  for (const SpinningPair& pair : {exadg(), trixi()}) {
    for (const Heard& heard : listen(pair, all, {})) {
      check_against_exact(heard);
      if (is_in_formula(pair, heard.model.analogy)) check_against_formula(pair, heard);
    }
  }
}

TEST_CASE("at half its Mach number as the formula says, with every analogy", "[serial]") {
  SpinningPair pair = exadg();
  pair.speed_of_sound *= 2;
  for (const Heard& heard : listen(pair, {{"pressure_rate"}, {"pcwe"}, {"ape"}, {"lighthill"}, {"vortex"}}, {})) {
    check_against_formula(pair, heard);
  }
}

TEST_CASE("all analogies, parameter sets, cores, Mach numbers and resolutions", "[.table]") {
  const std::vector<Model> all = {{"pressure_rate"}, {"pcwe"}, {"ape"}, {"lighthill"}, {"vortex"}};
  const Resolution coarse, fine = {.growth = 0.08, .cells_a_wavelength = 30, .steps_a_period = 48};
  const auto row = [&](const char* name, const SpinningPair& pair, const std::vector<Model>& models,
                       const Resolution& resolution, int periods) {
    if (base::rank(MPI_COMM_WORLD) == 0) {
      std::printf("%s, M = %.4f, r_c = %.3f r0, core's factor %.4f, %g cells a wavelength, %d periods\n", name,
                  pair.mach_number(), pair.core_radius / pair.orbit, quadrupole_of_cores(pair),
                  resolution.cells_a_wavelength, periods);
    }
    listen(pair, models, resolution, periods);
  };
  for (const auto& [name, pair] : {std::pair("ExaDG", exadg()), {"Trixi", trixi()}}) {
    row(name, pair, all, coarse, 6);
    row(name, pair, {{"pcwe", false}, {"ape", false}}, coarse, 6);
    row(name, pair, {{"ape"}}, coarse, 24);
    SpinningPair other = pair;
    other.core_radius /= 2;
    row(name, other, all, coarse, 6);
    other = pair;
    other.core = Core::gaussian;
    row(name, other, all, coarse, 6);
    for (const double slower : {2, 4}) {
      other = pair;
      other.speed_of_sound *= slower;
      row(name, other, all, coarse, 6);
    }
    row(name, pair, all, fine, 6);
  }
}
