#include <cmath>

#include "tests/coupling/made_flow.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

/// Of no symmetry, on a mesh whose inside swings.
const test::MadeFlow wild = {
    [](const test::Point& x, double t) { return std::sin(9 * x[0] - 4 * x[1] + 50 * t) + 3 * t; },
    [](const test::Point& x, double t) {
      return test::Point{std::sin(7 * x[0] + 20 * t) + 0.3, std::cos(5 * x[0] * x[1]) - t, 0};
    },
    [](const test::Point& x, double t) {
      return test::Point{0.01 * std::sin(M_PI * x[0]) * std::sin(M_PI * x[1]) * std::sin(60 * t), 0, 0};
    }};

acoustic::AcousticSettings settings(const std::string& analogy, PressureDerivative derivative, double dt) {
  acoustic::AcousticSettings result;
  result.speed_of_sound = 20;
  result.step = dt;
  result.boundaries = {{"right", acoustic::AcousticBoundaryKind::open}};
  result.analogy.name = analogy;
  result.analogy.pressure_derivative = derivative;
  result.analogy.mean_flow = true;
  result.analogy.mean_time = 0.02;
  return result;
}

std::unique_ptr<Scene> room() {
  return test::box_scene({1, 1, 0}, {8, 8, 0}, [](const auto&) { return RegionKind::fluid; });
}

}  // namespace

TEST_CASE("a voice goes on from the solver's state, its analogy's memory and the flow's snapshots to the last bit") {
  using D = PressureDerivative;
  const double dt = 2e-3;
  Case config;
  config.flow.emplace();
  config.microphones = {{"here", {0.3, 0.6, 0}}};
  for (const auto& [analogy, derivative] : std::vector<std::pair<std::string, D>>{{"pressure_rate", D::five_point},
                                                                                  {"pressure_rate", D::bdf2},
                                                                                  {"pcwe", D::five_point},
                                                                                  {"ape", D::step},
                                                                                  {"vortex", D::step}}) {
    CAPTURE(analogy);
    const auto scene = room(), other_scene = room();
    Voice voice(*scene, config, settings(analogy, derivative, dt));
    Voice other(*other_scene, config, settings(analogy, derivative, dt));
    test::Lead lead(*scene, wild, dt), other_lead(*other_scene, wild, dt);
    Voice *here[] = {&voice}, *there[] = {&other};
    for (int n = 0; n < 9; ++n) lead.step(here);
    voice.microphones().collect();

    other_lead.go_on_from(lead);
    other.solver().set_state(voice.solver().state());
    const auto memory = voice.analogy().memory(), other_memory = other.analogy().memory();
    REQUIRE_ON_ALL_RANKS(memory.size() == other_memory.size());
    for (std::size_t i = 0; i < memory.size(); ++i) *other_memory[i] = *memory[i];
    other.move_to(other_lead.history().displacement(other_lead.history().followed(derivative)));
    voice.drop_caches();
    other.drop_caches();
    for (int n = 0; n < 4; ++n) {
      lead.step(here);
      other_lead.step(there);
    }
    CHECK(voice.solver().state().p == other.solver().state().p);
    CHECK(voice.solver().state().psi == other.solver().state().psi);
    CHECK(voice.microphones().collect().values == other.microphones().collect().values);
    const double lag = lag_of(derivative) * dt;
    CHECK(voice.solver().state().time == Approx(lead.time() - lag));
  }
}
