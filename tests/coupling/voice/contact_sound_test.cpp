// Sound in a duct that cells in contact close and open: the marks are set by hand, the flow is at rest.
#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "coupling/voice/voice.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"
#include "tests/coupling/voice/swinging_mesh.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using acoustic::ContactCells;
using acoustic::Integrator;

namespace {

constexpr double length = 0.2, height = 0.02, speed = 350, density = 1.2, dt = 2e-5;

/// A duct of fluid with air beyond 0.15.
std::unique_ptr<Scene> duct(MPI_Comm comm = MPI_COMM_WORLD) {
  return test::box_scene(
      {length, height, 0}, {40, 4, 0}, [](const auto& x) { return x[0] < 0.15 ? RegionKind::fluid : RegionKind::air; },
      comm);
}

Case config_with_microphones() {
  Case config;
  config.flow.emplace();
  config.time.step = dt;
  config.microphones = {{"before", {0.0525, 0.011, 0}}, {"behind", {0.1625, 0.011, 0}}, {"within", {0.092, 0.011, 0}}};
  return config;
}

acoustic::AcousticSettings settings_with(ContactCells contact_cells, Integrator integrator = Integrator::automatic) {
  acoustic::AcousticSettings settings;
  settings.analogy.name = "none";
  settings.speed_of_sound = speed;
  settings.density = density;
  settings.step = dt / 2;
  settings.integrator = integrator;
  settings.solver_tolerance = 1e-12;
  settings.contact_cells = contact_cells;
  return settings;
}

/// Marks the cells of the flow mesh whose centre lies between two x; none if they are equal.
std::vector<char> plug(const Scene& scene, double low, double high) {
  const mesh::Mesh& mesh = scene.flow->mesh;
  std::vector<char> marks;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double x = 0;
    for (const std::int32_t v : mesh.vertices_of(cell)) x += mesh.point(v)[0] / 3;
    marks.push_back(x > low && x < high);
  }
  return marks;
}

/// A flow at rest on a mesh that swings by so much along x.
test::SwingingMesh at_rest(const Scene& scene, double amplitude) {
  return {scene, [amplitude](double x, double t) {
            return amplitude * std::sin(M_PI * x / 0.15) * std::sin(2 * M_PI * 2000 * t);
          }};
}

/// A pulse of 1 Pa on the left; silence from 0.08 on.
void shout(Voice& voice) {
  acoustic::State state = voice.solver().state();
  const mesh::Mesh& mesh = voice.mesh();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double x = mesh.point(v)[0];
    state.p[v] = x < 0.08 ? std::exp(-std::pow((x - 0.03) / 0.012, 2)) : 0;
  }
  voice.solver().set_state(std::move(state));
}

void go(Voice& voice, const test::SwingingMesh& flow, int first, int last) {
  for (int n = first; n < last; ++n) {
    const double begin = n * dt, end = (n + 1) * dt;
    CHECK(voice.follow(flow.view(begin, end), flow.displacement(begin), flow.displacement(end)).converged);
  }
}

struct Heard {
  acoustic::Microphones::Block block;
  double largest(int microphone, double from, double to) const {
    double result = 0;
    for (std::size_t i = 0; i < block.times.size(); ++i) {
      if (block.times[i] > from && block.times[i] <= to)
        result = std::max(result, std::abs(block.values[3 * i + microphone]));
    }
    return result;
  }
};

constexpr int closes_at = 2, opens_at = 40, ends_at = 80;

/// Closed by `low` to `high` from step 2, when 1e-13 of the pulse has passed 0.11, to step 40, of 80.
Heard run(MPI_Comm comm, const acoustic::AcousticSettings& settings, double amplitude, double low, double high,
          Rebuilds* rebuilds = nullptr) {
  const auto scene = duct(comm);
  Voice voice(*scene, config_with_microphones(), settings);
  const test::SwingingMesh flow = at_rest(*scene, amplitude);
  shout(voice);
  go(voice, flow, 0, closes_at);
  voice.follow_contact(plug(*scene, low, high), flow.displacement(closes_at * dt));
  go(voice, flow, closes_at, opens_at);
  voice.follow_contact({}, flow.displacement(opens_at * dt));
  go(voice, flow, opens_at, ends_at);
  if (rebuilds) *rebuilds = voice.rebuilds();
  return {voice.microphones().collect()};
}

bool is_first() { return base::rank(MPI_COMM_WORLD) == 0; }

}  // namespace

TEST_CASE("sound before a plug of contact cells is heard behind it when it has opened, and not before") {
  for (const double amplitude : {0.0, 1e-3}) {
    for (const Integrator integrator : {Integrator::automatic, Integrator::implicit, Integrator::leap_frog}) {
      const Heard stripped = run(MPI_COMM_WORLD, settings_with(ContactCells::strip, integrator), amplitude, 0.09, 0.11);
      const Heard kept = run(MPI_COMM_WORLD, settings_with(ContactCells::keep, integrator), amplitude, 0.09, 0.11);
      if (!is_first()) continue;
      CHECK(stripped.largest(1, closes_at * dt, opens_at * dt) < 1e-7);
      CHECK(stripped.largest(2, closes_at * dt, opens_at * dt) == 0);  // it hangs in a cell that is gone
      CHECK(stripped.largest(0, closes_at * dt, opens_at * dt) > 0.4);
      CHECK(stripped.largest(1, opens_at * dt, ends_at * dt) > 0.1);
      CHECK(stripped.largest(2, opens_at * dt, ends_at * dt) > 0.1);
      CHECK(kept.largest(1, closes_at * dt, opens_at * dt) > 0.4);
      for (const Heard* heard : {&stripped, &kept}) {
        REQUIRE(heard->block.times.size() == 2 * ends_at);
        for (std::size_t i = 0; i < heard->block.times.size(); ++i) {
          CHECK(heard->block.times[i] == Approx(static_cast<double>(i + 1) * dt / 2));
        }
      }
    }
  }
}

TEST_CASE("without cells in contact strip is keep, to the last bit") {
  const Heard stripped = run(MPI_COMM_WORLD, settings_with(ContactCells::strip), 1e-3, 0, 0);
  const Heard kept = run(MPI_COMM_WORLD, settings_with(ContactCells::keep), 1e-3, 0, 0);
  CHECK(stripped.block.values == kept.block.values);
}

TEST_CASE("the energy that stripping takes is told") {
  Rebuilds rebuilds;
  run(MPI_COMM_WORLD, settings_with(ContactCells::strip), 0, 0.09, 0.11, &rebuilds);
  CHECK(rebuilds.count == 2);
  // The pulse is before the plug when it closes, and p and ψ behind it are small when it opens.
  const double pulse = 0.5 / (density * speed * speed) * height * 0.012 * std::sqrt(M_PI / 2);
  CHECK(std::abs(rebuilds.energy_lost) < 0.2 * pulse);
  const auto scene = duct();
  Voice voice(*scene, config_with_microphones(), settings_with(ContactCells::strip));
  const test::SwingingMesh flow = at_rest(*scene, 0);
  shout(voice);
  const double energy = voice.solver().energy();
  double lost = 0;
  const auto close = [&](double low, double high) {
    const double before = voice.solver().energy();
    voice.follow_contact(plug(*scene, low, high), flow.displacement(0));
    lost += before - voice.solver().energy();
  };
  close(0.02, 0.04);  // takes most of it
  CHECK(voice.solver().energy() < 0.6 * energy);
  close(0.01, 0.03);
  close(0, 0);
  close(0, 0);
  CHECK(voice.rebuilds().count == 3);
  CHECK(voice.rebuilds().energy_lost == Approx(lost));
}

TEST_CASE("microphones hear the same on any ranks, though ranks lose all their air") {
  const auto scene = duct();
  const auto closed = make_air(*scene, plug(*scene, 0.035, 0.15));
  if (base::size(MPI_COMM_WORLD) == 4) CHECK(base::smallest(MPI_COMM_WORLD, closed->mesh().num_cells()) == 0);
  for (const double amplitude : {0.0, 1e-3}) {
    const Heard together = run(MPI_COMM_WORLD, settings_with(ContactCells::strip), amplitude, 0.035, 0.15);
    const Heard alone = run(MPI_COMM_SELF, settings_with(ContactCells::strip), amplitude, 0.035, 0.15);
    if (!is_first()) continue;
    REQUIRE(together.block.values.size() == alone.block.values.size());
    double difference = 0;
    for (std::size_t i = 0; i < alone.block.values.size(); ++i) {
      difference = std::max(difference, std::abs(alone.block.values[i] - together.block.values[i]));
    }
    CHECK(difference < 1e-8);
  }
}

TEST_CASE("air that is closed off on both sides sounds by itself") {
  const auto scene = duct();
  Voice voice(*scene, config_with_microphones(), settings_with(ContactCells::strip));
  const test::SwingingMesh flow = at_rest(*scene, 0);
  shout(voice);
  std::vector<char> marks = plug(*scene, 0.01, 0.02);
  const std::vector<char> other = plug(*scene, 0.09, 0.1);
  for (std::size_t cell = 0; cell < marks.size(); ++cell) marks[cell] |= other[cell];
  voice.follow_contact(marks, flow.displacement(0));
  const double energy = voice.solver().energy();
  go(voice, flow, 0, 40);
  CHECK(voice.solver().energy() == Approx(energy).epsilon(0.01));
  const Heard heard{voice.microphones().collect()};
  if (!is_first()) return;
  CHECK(heard.largest(0, 10 * dt, 40 * dt) > 0.2);
  CHECK(heard.largest(1, 0, 40 * dt) == 0);
}

TEST_CASE("a voice put on the stripped air and given the state goes on as one that was there all the time") {
  const auto scene = duct(), other_scene = duct();
  const Case config = config_with_microphones();
  Voice voice(*scene, config, settings_with(ContactCells::strip));
  Voice other(*other_scene, config, settings_with(ContactCells::strip));
  const test::SwingingMesh flow = at_rest(*scene, 1e-3), other_flow = at_rest(*other_scene, 1e-3);
  shout(voice);
  go(voice, flow, 0, 5);
  voice.follow_contact(plug(*scene, 0.09, 0.11), flow.displacement(5 * dt));
  go(voice, flow, 5, 12);
  voice.microphones().collect();
  other.follow_contact(plug(*other_scene, 0.09, 0.11), other_flow.displacement(12 * dt));
  other.solver().set_state(voice.solver().state());
  other.move_to(other_flow.displacement(12 * dt));
  voice.drop_caches();
  other.drop_caches();
  for (const bool opens : {false, true}) {
    if (opens) voice.follow_contact({}, flow.displacement(16 * dt));
    if (opens) other.follow_contact({}, other_flow.displacement(16 * dt));
    go(voice, flow, opens ? 16 : 12, opens ? 20 : 16);
    go(other, other_flow, opens ? 16 : 12, opens ? 20 : 16);
    CHECK(voice.solver().state().p == other.solver().state().p);
    CHECK(voice.solver().state().psi == other.solver().state().psi);
    CHECK(voice.microphones().collect().values == other.microphones().collect().values);
  }
}

TEST_CASE("voices on one flow choose each for itself") {
  const auto scene = duct();
  const Case config = config_with_microphones();
  Voice first(*scene, config, settings_with(ContactCells::strip)),
      second(*scene, config, settings_with(ContactCells::keep));
  const test::SwingingMesh flow = at_rest(*scene, 1e-3);
  shout(first);
  shout(second);
  for (int n = 0; n < 30; ++n) {
    if (n == closes_at || n == 20) {
      const std::vector<char> marks = n == closes_at ? plug(*scene, 0.09, 0.11) : std::vector<char>();
      first.follow_contact(marks, flow.displacement(n * dt));
      second.follow_contact(marks, flow.displacement(n * dt));
    }
    go(first, flow, n, n + 1);
    go(second, flow, n, n + 1);
  }
  const Heard heard = run(MPI_COMM_WORLD, settings_with(ContactCells::keep), 1e-3, 0.09, 0.11);
  const auto kept = second.microphones().collect();
  CHECK(std::equal(kept.values.begin(), kept.values.end(), heard.block.values.begin()));
  const Heard stripped{first.microphones().collect()};
  if (is_first()) CHECK(stripped.largest(1, closes_at * dt, 20 * dt) < 1e-7);
}
