#include <algorithm>
#include <cmath>

#include "coupling/monitors/monitors.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

TEST_CASE("the energies of a bar that falls and swings balance, the better the smaller the step, and BDF2 makes none") {
  auto scene = test::box_scene({2, 1, 0}, {4, 2, 0}, [](const fem::Point&) { return RegionKind::solid; });
  fsi::FlowSettings settings;
  settings.elements = fsi::Elements::p2p1;
  settings.solids = {{.region = "solid", .density = 1000, .young_modulus = 1e6, .damping = 200}};
  settings.gravity = {0, -10, 0};
  settings.boundaries = {{.group = "left", .kind = fsi::FlowBoundaryKind::fixed}};
  settings.newton_tolerance = 1e-9;
  MonitorSettings energies;
  energies.kind = MonitorKind::energy;
  energies.name = "energy";
  for (const fsi::TimeScheme scheme : {fsi::TimeScheme::theta, fsi::TimeScheme::bdf2}) {
    double residual[2], largest = 0, rise = 0;
    for (int i = 0; i < 2; ++i) {
      const double step = i == 0 ? 0.004 : 0.002;
      fsi::FsiSolver flow(scene->flow->mesh, settings, {.end = 1, .step = step, .scheme = scheme});
      Monitors monitors(flow, {energies});
      REQUIRE_ON_ALL_RANKS(monitors.columns().size() == 5);
      std::vector<double> values(5, 0.0);
      for (int n = 0; n < (i == 0 ? 20 : 40); ++n) {
        REQUIRE_ON_ALL_RANKS(flow.try_step(step).converged);
        flow.accept();
        monitors.follow_step();
        const double before = values[4];
        values = monitors.evaluate();
        rise = std::max(rise, values[4] - before);
        largest = std::max(largest, values[0] + values[1]);
      }
      CHECK(values[0] > 0);
      CHECK(values[1] > 0);
      CHECK(values[3] > 0);
      residual[i] = std::abs(values[4]);
    }
    INFO("residuals " << residual[0] << " and " << residual[1] << " of " << largest << " J, rise " << rise);
    CHECK(rise < (scheme == fsi::TimeScheme::bdf2 ? 1e-12 : 1e-6) * largest);
    CHECK(residual[1] < 5e-4 * largest);
    CHECK(residual[1] < 0.3 * residual[0]);
  }
}
