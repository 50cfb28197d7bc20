#include "coupling/voice/voice.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"
#include "tests/coupling/voice/swinging_mesh.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

// A piston blows u(t) into a duct. The flow reaches to x = L, where it ends inside the air of a duct that goes on for
// ever, so its pressure is p_ic = ρ u'(t) (L - x), and 0 in the air beyond. The sound of the whole is u ρ c,
// travelling.
// Analogies differ by the flow's Mach number, which is out of sight here.
constexpr double length = 0.17, speed = 350, density = 1.14, width = 0.2e-3, delay = 1.2e-3, amplitude = 1e-4;
double blown(double t) { return amplitude * std::exp(-std::pow((t - delay) / width, 2)); }
double blown_rate(double t) { return -2 * (t - delay) / (width * width) * blown(t); }
double incompressible(double x, double t) { return x < length ? density * blown_rate(t) * (length - x) : 0; }
double travelling(double x, double t) { return density * speed * blown(t - x / speed); }

std::unique_ptr<Scene> duct(int cells) {
  return test::box_scene({2 * length, 4 * length / cells, 0}, {cells, 2, 0},
                         [](const auto& x) { return x[0] < length ? RegionKind::fluid : RegionKind::air; });
}

Case case_with_microphones() {
  Case config;
  config.flow.emplace();
  config.microphones = {{"inside", {0.3 * length, 0.001, 0}}, {"beyond", {1.5 * length, 0.001, 0}}};
  return config;
}

acoustic::AcousticSettings air(double step) {
  acoustic::AcousticSettings settings;
  settings.speed_of_sound = speed;
  settings.density = density;
  settings.step = step;
  settings.boundaries = {{"right", acoustic::AcousticBoundaryKind::open}};
  return settings;
}

/// The flow above, on a mesh that moves by displacement(X, t) along x.
class BlownFlow {
 public:
  BlownFlow(const Scene& scene, double (*displacement)(double x, double t))
      : scene_(scene), swinging_(scene, displacement) {}

  fem::Field displacement(double time) const { return swinging_.displacement(time); }

  FlowView view(double begin, double end) const {
    FlowView view = swinging_.view(begin, end);
    view.outlet = flow_outlet(scene_);
    view.walls = flow_walls(scene_);
    const fem::Field first = displacement(begin), last = displacement(end);
    for (std::int32_t v = 0; v < scene_.flow->mesh.num_vertices(); ++v) {
      const double x = scene_.flow->mesh.point(v)[0];
      view.pressure_begin[v] = incompressible(x + first.at(v)[0], begin);
      view.pressure_end[v] = incompressible(x + last.at(v)[0], end);
      view.velocity_begin[2 * static_cast<std::size_t>(v)] = blown(begin);
      view.velocity_end[2 * static_cast<std::size_t>(v)] = blown(end);
    }
    return view;
  }

  /// Whether a voice could follow it.
  bool leads(Voice& voice, double begin, double end) const {
    return voice.follow(view(begin, end), displacement(begin), displacement(end)).converged;
  }

 private:
  const Scene& scene_;
  test::SwingingMesh swinging_;
};

double nowhere(double, double) { return 0; }
/// Zero at x = 0 and x = L; the mesh swings by 4 mm within 1 ms.
double swing(double x, double t) {
  return x < length ? 0.004 * std::sin(M_PI * x / length) * std::sin(2 * M_PI * 1000 * t) : 0;
}

/// Largest |p_ic + p_a - exact| at both microphones over the largest |exact|.
double error_of_duct(int cells, double (*displacement)(double, double), const std::string& analogy = "pressure_rate") {
  const auto scene = duct(cells);
  const double dt = 2 * length / cells / speed;
  const Case config = case_with_microphones();
  acoustic::AcousticSettings settings = air(0.51 * dt);  // two sub-steps
  settings.analogy.name = analogy;
  settings.analogy.mean_time = 1e-2;
  Voice voice(*scene, config, settings);
  const BlownFlow flow(*scene, displacement);
  bool converged = true;
  for (int n = 0; n * dt < 3e-3; ++n) {
    converged = converged && flow.leads(voice, n * dt, (n + 1) * dt);
  }
  CHECK(converged);
  const auto block = voice.microphones().collect();
  double worst = 0;
  for (std::size_t sample = 1; sample < block.times.size(); sample += 2) {  // after each step: p_ic is meant there
    for (std::size_t m = 0; m < 2; ++m) {
      const double x = config.microphones[m].position[0], t = block.times[sample];
      CHECK(block.flow[2 * sample + m] == Approx(incompressible(x, t)).margin(1e-9 * density * speed * amplitude));
      const double sum = block.values[2 * sample + m] + block.flow[2 * sample + m];
      worst = std::max(worst, std::abs(sum - travelling(x, t)) / (density * speed * amplitude));
    }
  }
  return base::largest(MPI_COMM_WORLD, worst);
}

}  // namespace

TEST_CASE("the flow's pressure and its sound together are the sound of the duct") {
  const double coarse = error_of_duct(80, nowhere), fine = error_of_duct(160, nowhere);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.1);
  CHECK(coarse / fine > 3);  // second order
}

TEST_CASE("the same while the mesh swings, and microphones stay where they are") {
  const double coarse = error_of_duct(80, swing), fine = error_of_duct(160, swing);
  CAPTURE(coarse, fine);
  CHECK(coarse < 0.1);
  CHECK(coarse / fine > 3);
}

TEST_CASE("analogies for p_a and for the whole pressure give the same sound of the duct") {
  for (const std::string analogy : {"pcwe", "lighthill", "vortex", "ape"}) {
    for (const auto displacement : {nowhere, swing}) {
      const double coarse = error_of_duct(80, displacement, analogy), fine = error_of_duct(160, displacement, analogy);
      CAPTURE(analogy, coarse, fine);
      CHECK(coarse < 0.1);
      CHECK(coarse / fine > 3);
    }
  }
}

TEST_CASE("voices that share their matrices sound as each of them alone") {
  for (const auto displacement : {nowhere, swing}) {
    const auto scene = duct(40);
    const double dt = 2e-5;
    const Case config = case_with_microphones();
    acoustic::AcousticSettings settings = air(0.51 * dt), other_settings = settings;
    other_settings.name = "other";
    other_settings.analogy.name = "lighthill";
    CHECK(differ_in_source_alone(settings, other_settings));
    Voice one(*scene, config, settings), alone(*scene, config, other_settings);
    Voice beside(*scene, config, other_settings, &one);
    const BlownFlow flow(*scene, displacement);
    for (int n = 50; n < 60; ++n) {
      for (Voice* voice : {&one, &beside, &alone}) CHECK(flow.leads(*voice, n * dt, (n + 1) * dt));
    }
    double difference = 0, largest = 0;
    const auto p = beside.pressure().values, q = alone.pressure().values;
    for (std::size_t v = 0; v < p.size(); ++v) {
      difference = std::max(difference, std::abs(p[v] - q[v]));
      largest = std::max(largest, std::abs(q[v]));
    }
    CHECK(base::largest(MPI_COMM_WORLD, difference) < 1e-6 * base::largest(MPI_COMM_WORLD, largest));
  }
}

TEST_CASE("a prescribed flux is the sound of a piston") {
  const auto scene = test::box_scene({length, 0.004, 0}, {80, 2, 0}, [](const auto&) { return RegionKind::air; });
  Case config;
  config.microphones = {{"end", {0.9 * length, 0.001, 0}}};
  acoustic::AcousticSettings settings = air(3e-6);
  settings.boundaries.push_back({.group = "left", .kind = acoustic::AcousticBoundaryKind::flux});
  scene->flow.reset();
  Voice voice(*scene, config, settings);
  for (int n = 0; n < 100; ++n) CHECK(voice.drive(3e-5, blown).converged);
  const auto block = voice.microphones().collect();
  double worst = 0;
  for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
    const double exact = travelling(0.9 * length, block.times[sample]);
    worst = std::max(worst, std::abs(block.values[sample] - exact) / (density * speed * amplitude));
  }
  CHECK(worst < 0.01);
  if (base::rank(MPI_COMM_WORLD) == 0) CHECK(block.times.size() == 1000);
}

TEST_CASE("the source fades in") {
  const auto scene = duct(40);
  const double dt = 1e-5;
  const BlownFlow flow(*scene, nowhere);
  const auto sound_after_one_step = [&](double begin, double fade_in) {
    acoustic::AcousticSettings settings = air(dt);
    settings.analogy.fade_in = fade_in;
    Voice voice(*scene, case_with_microphones(), settings);
    CHECK(flow.leads(voice, begin, begin + dt));
    double largest = 0;
    for (const double p : voice.solver().state().p) largest = std::max(largest, std::abs(p));
    return base::largest(MPI_COMM_WORLD, largest);
  };
  const double whole = sound_after_one_step(1e-3, 0);
  CHECK(whole > 0);
  CHECK(sound_after_one_step(1e-3, 1e-3) == whole);
  CHECK(sound_after_one_step(1e-3, 2e-3 + dt) == Approx(whole / 2).epsilon(0.05));
  CHECK(sound_after_one_step(1e-3, 1) < 1e-4 * whole);
}

TEST_CASE("a voice that was moved and has forgotten its caches goes on as one that was there all the time") {
  const auto scene = duct(40), other_scene = duct(40);
  const double dt = 2e-5;
  const Case config = case_with_microphones();
  Voice voice(*scene, config, air(dt)), other(*other_scene, config, air(dt));
  const BlownFlow flow(*scene, swing), other_flow(*other_scene, swing);
  for (int n = 0; n < 8; ++n) CHECK(flow.leads(voice, n * dt, (n + 1) * dt));
  voice.microphones().collect();
  other.solver().set_state(voice.solver().state());
  other.move_to(other_flow.displacement(8 * dt));
  voice.drop_caches();
  other.drop_caches();
  for (int n = 8; n < 12; ++n) {
    CHECK(flow.leads(voice, n * dt, (n + 1) * dt));
    CHECK(other_flow.leads(other, n * dt, (n + 1) * dt));
  }
  CHECK(voice.solver().state().p == other.solver().state().p);
  CHECK(voice.solver().state().psi == other.solver().state().psi);
  CHECK(voice.microphones().collect().values == other.microphones().collect().values);
}

TEST_CASE("a microphone outside of the air is the user's mistake") {
  const auto scene = duct(20);
  Case config;
  config.microphones = {{"far", {1, 1, 0}}};
  CHECK_THROWS_AS(Voice(*scene, config, air(1e-5)), base::UserError);
}

TEST_CASE("the flow's pressure at a microphone goes straight over a step, and ends with the flow") {
  const auto scene = duct(40);
  const double begin = 1.1e-3, dt = 1e-4;
  Voice voice(*scene, case_with_microphones(), air(dt / 4));
  CHECK(voice.in_flow() == std::vector<std::int32_t>{1, 0});
  const BlownFlow flow(*scene, nowhere);
  CHECK(flow.leads(voice, begin, begin + dt));
  const auto block = voice.microphones().collect();
  REQUIRE_ON_ALL_RANKS(block.flow.size() == (base::rank(MPI_COMM_WORLD) == 0 ? 8u : 0u));
  for (std::size_t sample = 0; sample < block.times.size(); ++sample) {
    const double part = 0.25 * static_cast<double>(sample + 1), x = 0.3 * length;
    const double exact = (1 - part) * incompressible(x, begin) + part * incompressible(x, begin + dt);
    CHECK(block.flow[2 * sample] == Approx(exact));
    CHECK(block.flow[2 * sample + 1] == 0);
  }
}

TEST_CASE("a far field through a layer that absorbs sound is the user's mistake") {
  const auto scene = test::box_scene({0.1, 0.05, 0.05}, {10, 5, 5}, [](const auto&) { return RegionKind::air; });
  scene->flow.reset();
  Case config;
  config.microphones = {{"far", {0.3, 0, 0}, acoustic::MicrophoneKind::far_field, "right", {{0, 0}}}};
  acoustic::AcousticSettings settings;
  settings.step = 1e-5;
  CHECK_NOTHROW(Voice(*scene, config, settings));
  acoustic::AbsorbingLayer layer;
  layer.sides = {acoustic::BoxSide::x_max};
  layer.thickness = 0.03;
  settings.layers = {layer};
  CHECK_THROWS_WITH(Voice(*scene, config, settings), Catch::Contains("before the layers"));
}
