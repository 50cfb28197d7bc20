
#include "core/base/mpi.hpp"
#include "coupling/analogies/ape.hpp"
#include "coupling/analogies/pressure_rate.hpp"
#include "coupling/analogies/vortex.hpp"
#include "tests/coupling/made_flow.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using test::Point;

namespace {

constexpr double density = 1.2;

/// One step of a flow through a channel, 1 long and ½ high, into the air.
struct Channel {
  Channel()
      : scene(test::box_scene({1.5, 0.5, 0}, {9, 4, 0},
                              [](const Point& x) { return x[0] < 1 ? RegionKind::fluid : RegionKind::air; })),
        history(*scene, 2, false) {
    const test::MadeFlow flow = {[](const Point&, double t) { return 100 * t; },
                                 [](const Point& x, double) {
                                   return Point{2, 3 * x[1], 0};
                                 },
                                 {}};
    history.restart(test::snapshot(*scene, flow, 0));
    history.add(test::snapshot(*scene, flow, 0.1));
    view = history.step(PressureDerivative::step).view;
  }
  AnalogyMedium medium(double weight) const {
    return {density, 340, std::vector<double>(scene->flow->mesh.num_vertices(), weight)};
  }
  std::unique_ptr<Scene> scene;
  FlowHistory history;
  FlowView view;
};

double total(const fem::Load& load) {
  double sum = 0;
  for (const double value : load.values) sum += value;
  return base::sum(MPI_COMM_WORLD, sum);
}

}  // namespace

TEST_CASE("a window weighs the rate in the volume and the flux through the outlet alike") {
  const Channel channel;
  const double whole = total(PressureRate(channel.medium(1)).source(channel.view).end);
  CHECK(whole == Approx(2 * 0.5 - 100 * 0.5 / (density * 340 * 340)).epsilon(1e-12));
  CHECK(total(PressureRate(channel.medium(0.25)).source(channel.view).end) == Approx(0.25 * whole).epsilon(1e-12));
  CHECK(total(PressureRate(channel.medium(0)).source(channel.view).end) == 0);
}

TEST_CASE("what of an enthalpy is no pressure is weighed by the window, as the source is that brings it") {
  const Channel channel;
  acoustic::AnalogySettings settings;
  settings.mean_time = 1;
  AcousticPerturbation ape(settings, channel.medium(0.25));
  ape.follow(channel.view);
  std::vector<double> other = channel.view.velocity_end;
  for (double& component : other) component += 1;
  const std::vector<double> of_vortex = VortexSound(channel.medium(0.25)).head(channel.view, other);
  const std::vector<double> of_ape = ape.head(channel.view, other);
  for (std::size_t v = 0; v < of_vortex.size(); ++v) {
    const double u = other[2 * v], w = other[2 * v + 1];
    CHECK(of_vortex[v] == Approx(0.25 * 0.5 * density * (u * u + w * w)));
    CHECK(of_ape[v] == Approx(0.25 * density * (u - 1 + w - 1)));  // U·u', u' = (1, 1)
  }
}
