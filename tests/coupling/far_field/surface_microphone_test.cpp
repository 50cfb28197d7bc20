#include "coupling/far_field/surface_microphone.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <set>

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "core/mesh/partition.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::coupling;

namespace {

using Point = std::array<double, 3>;
using std::numbers::pi;

constexpr double c = 340, density = 1.2, frequency = 300, omega = 2 * pi * frequency, period = 1 / frequency;
const Point far_away = {2.1, 1.3, 0};

/// The box [-0.2, 0.2]^d with the cells within 0.05 solid; groups: "control" where all coordinates are within 0.1,
/// "body" where the solid ends. Facets that are inside are listed once.
mesh::WholeMesh box_around_a_body(int dimension, int cells) {
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {0.4, 0.4, dimension == 3 ? 0.4 : 0.0}, {cells, cells, cells});
  for (double& x : whole.coordinates) x -= 0.2;
  const int d = dimension;
  const auto largest = [&](std::int64_t v) {
    double result = 0;
    for (int k = 0; k < d; ++k) result = std::max(result, std::abs(whole.coordinates[v * d + k]));
    return result;
  };
  whole.region_names = {"fluid", "solid"};
  const std::int32_t first = static_cast<std::int32_t>(whole.group_names.size());
  if (base::rank(MPI_COMM_WORLD) == 0) {
    whole.group_names.insert(whole.group_names.end(), {"control", "body", "half"});
  }
  std::set<std::vector<std::int64_t>> seen;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    const std::int64_t* corners = whole.cell_vertices.data() + cell * (d + 1);
    double outermost = 0;
    for (int i = 0; i <= d; ++i) outermost = std::max(outermost, largest(corners[i]));
    if (outermost < 0.05 + 1e-9) whole.cell_region[cell] = 1;
    for (int opposite = 0; opposite <= d; ++opposite) {
      std::vector<std::int64_t> facet;
      for (int i = 0; i <= d; ++i) {
        if (i != opposite) facet.push_back(corners[i]);
      }
      std::sort(facet.begin(), facet.end());
      for (const auto& [group, size] : {std::pair{first, 0.1}, std::pair{first + 1, 0.05}}) {
        bool is_on_a_side = false, is_within = true, is_above = true;
        for (int k = 0; k < d; ++k) {
          for (const double sign : {-1.0, 1.0}) {
            is_on_a_side |= std::all_of(facet.begin(), facet.end(), [&](std::int64_t v) {
              return std::abs(whole.coordinates[v * d + k] - sign * size) < 1e-9;
            });
          }
        }
        for (const std::int64_t v : facet) {
          is_within &= largest(v) < size + 1e-9;
          is_above &= whole.coordinates[v * d + 1] > -1e-9;
        }
        if (!is_on_a_side || !is_within || !seen.insert(facet).second) continue;
        whole.facet_vertices.insert(whole.facet_vertices.end(), facet.begin(), facet.end());
        whole.facet_group.push_back(group);
        if (group != first || !is_above) continue;
        whole.facet_vertices.insert(whole.facet_vertices.end(), facet.begin(), facet.end());
        whole.facet_group.push_back(first + 2);
      }
    }
  }
  return whole;
}

std::vector<std::int32_t> fluid(const mesh::Mesh& mesh) {
  std::vector<std::int32_t> result;
  for (const std::int32_t region : mesh.cell_region) result.push_back(region == 0);
  return result;
}

SurfaceMicrophoneSettings microphone(SurfaceMethod method, std::vector<std::string> groups, const Point& position) {
  SurfaceMicrophoneSettings settings;
  settings.name = "ear";
  settings.position = position;
  settings.method = method;
  settings.groups = std::move(groups);
  settings.viscous_stress = false;
  settings.speed_of_sound = c;
  return settings;
}

/// A small sound in the fluid, p e^{iωt} and the velocity that it makes, rising over two periods.
struct Sound {
  std::function<std::complex<double>(const Point&)> pressure;
  std::function<std::array<std::complex<double>, 3>(const Point&)> velocity;
};

/// A monopole in the middle of the body, in air with that speed of sound: p = A e^{-ikr} / r in space, A H0(kr) in the
/// plane.
Sound monopole(int dimension, double amplitude, double speed) {
  const double k = omega / speed;
  const std::complex<double> i(0, 1);
  const auto length = [](const Point& x) { return std::hypot(x[0], x[1], x[2]); };
  const auto h = [](int n, double x) { return std::complex<double>(std::cyl_bessel_j(n, x), -std::cyl_neumann(n, x)); };
  const auto pressure = [=](double r) { return amplitude * (dimension == 3 ? std::exp(-i * k * r) / r : h(0, k * r)); };
  const auto slope = [=](double r) {
    return amplitude * (dimension == 3 ? -(i * k + 1 / r) * std::exp(-i * k * r) / r : -k * h(1, k * r));
  };
  return {[=](const Point& x) { return pressure(length(x)); },
          [=](const Point& x) {
            const double r = length(x);
            const std::complex<double> radial = -slope(r) / (i * omega * density);
            return std::array<std::complex<double>, 3>{radial * x[0] / r, radial * x[1] / r, radial * x[2] / r};
          }};
}

FlowSnapshot snapshot(const mesh::Mesh& mesh, const Sound& sound, double time) {
  const int d = mesh.dimension;
  const double part = std::min(time / (2 * period), 1.0);
  const std::complex<double> now = 0.5 * (1 - std::cos(pi * part)) * std::exp(std::complex<double>(0, omega * time));
  FlowSnapshot result;
  result.time = time;
  result.displacement.assign(mesh.coordinates.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    Point x = {0, 0, 0};
    std::copy_n(mesh.point(v), d, x.begin());
    if (std::hypot(x[0], x[1], x[2]) < 1e-6) x[0] = 1e-6;  // inside the body
    result.pressure.push_back((sound.pressure(x) * now).real());
    const auto velocity = sound.velocity(x);
    for (int k = 0; k < d; ++k) result.velocity.push_back((velocity[k] * now).real());
  }
  return result;
}

/// The largest error over the last period, relative to the largest exact pressure, of what the surface says of a sound.
double error(int dimension, int cells, int samples, const SurfaceMicrophoneSettings& settings, const Sound& sound) {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(dimension, cells));
  constexpr int periods = 8;
  const double dt = period / samples;
  SurfaceMicrophone ear(mesh, fluid(mesh), {density, 0}, settings, {dt, periods * period});
  FlowSnapshot before = snapshot(mesh, sound, 0);
  double worst = 0, largest = 0;
  for (int n = 1; n <= samples * periods; ++n) {
    FlowSnapshot now = snapshot(mesh, sound, n * dt);
    const double heard = base::sum(MPI_COMM_WORLD, ear.follow(before, now));
    before = std::move(now);
    if (n <= samples * (periods - 1)) continue;
    const double exact = (sound.pressure(settings.position) * std::exp(std::complex<double>(0, omega * n * dt))).real();
    worst = std::max(worst, std::abs(heard - exact));
    largest = std::max(largest, std::abs(exact));
  }
  return worst / largest;
}

}  // namespace

TEST_CASE("a permeable surface makes an acoustic field again outside of it") {
  // The sound is so small that ρuu does not count. On the finer mesh straight lines in time leave (ωΔ)² 3/8 = 0.6 %,
  // and linear functions in space h² / 24 · 6 / a² = 1.6 % of the 1 / r² that the velocity has near its source.
  const auto settings = microphone(SurfaceMethod::ffowcs_williams_hawkings, {"control"}, far_away);
  for (const int dimension : {2, 3}) {
    const Sound sound = monopole(dimension, 1e-3, c);
    const double fine = error(dimension, 16, 48, settings, sound);
    CHECK(fine < 0.03);
    CHECK(error(dimension, 8, 24, settings, sound) > 3 * fine);
  }
}

TEST_CASE("a compact surface is heard from its middle, which is right where waves are long") {
  // ka is 0.55 at 340 m/s, and 0.055 where sound is ten times as fast: what is left out falls by a hundred.
  const auto error_of = [](double speed, bool is_compact) {
    auto settings = microphone(SurfaceMethod::ffowcs_williams_hawkings, {"control"}, far_away);
    settings.speed_of_sound = speed;
    settings.compact = is_compact;
    return error(2, 16, 48, settings, monopole(2, 1e-3, speed));
  };
  CHECK(error_of(c, true) > 0.1);
  CHECK(error_of(10 * c, true) < 0.03);
  CHECK(error_of(10 * c, false) < 0.03);
}

namespace {

/// One step of a steady state that came at once; what `follow` says after long.
double steady(const SurfaceMicrophoneSettings& settings, const mesh::Mesh& mesh, const FlowMaterial& material,
              const std::function<double(const Point&)>& pressure, const std::function<Point(const Point&)>& velocity) {
  const double dt = 1e-3;
  SurfaceMicrophone ear(mesh, fluid(mesh), material, settings, {dt, 1000 * dt});
  FlowSnapshot flow;
  flow.displacement.assign(mesh.coordinates.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    Point x = {0, 0, 0};
    std::copy_n(mesh.point(v), mesh.dimension, x.begin());
    flow.pressure.push_back(pressure(x));
    const Point u = velocity(x);
    flow.velocity.insert(flow.velocity.end(), u.begin(), u.begin() + mesh.dimension);
  }
  FlowSnapshot before = flow;
  double heard = 0;
  for (int n = 1; n <= 1000; ++n) {
    before.time = (n - 1) * dt;
    flow.time = n * dt;
    heard = ear.follow(before, flow);
  }
  return base::sum(MPI_COMM_WORLD, heard);
}

}  // namespace

TEST_CASE("the force of walls is that of the pressure and the viscous stress of the fluid on them") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(2, 16));
  auto settings = microphone(SurfaceMethod::curle, {"body"}, {0, 3, 0});
  settings.compact = true;
  settings.viscous_stress = true;
  const auto none = [](const Point&) { return Point{0, 0, 0}; };
  // p = 7 y on a square of the area 0.01 m²: the walls push the fluid by ∮ p n = ∇p A, heard as F / 2πr.
  const double push = steady(
      settings, mesh, {density, 0.1}, [](const Point& x) { return 7 * x[1]; }, none);
  CHECK(push == Approx(7 * 0.01 / (2 * pi * 3)).epsilon(1e-3));
  // Where u = (0, 5 y) the stress is the same everywhere, and the force none.
  const auto zero = [](const Point&) { return 0.0; };
  const auto stretching = [](const Point& x) { return Point{0, 5 * x[1], 0}; };
  CHECK(std::abs(steady(settings, mesh, {density, 0.1}, zero, stretching)) < 1e-12);
  // u = (0, y² / 2): 2 µ y pulls at the sides ±y of the length 0.1, in the cells there at the height of their middle.
  const auto growing = [](const Point& x) { return Point{0, 0.5 * x[1] * x[1], 0}; };
  const double drag = steady(settings, mesh, {density, 0.1}, zero, growing);
  constexpr double cell = 0.4 / 16, height = 0.05 + 0.5 * cell;
  const double force = -2 * 0.1 * (2 * height) * 0.1;
  CHECK(drag == Approx(force / (2 * pi * 3)).epsilon(2e-3));
}

TEST_CASE("a flow that passes a closed surface leaves its momentum there") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(2, 16));
  auto settings = microphone(SurfaceMethod::ffowcs_williams_hawkings, {"control"}, {0, 3, 0});
  settings.compact = true;
  const auto zero = [](const Point&) { return 0.0; };
  // ∮ ρ u u·n = ∫ ρ (u·∇)u with u = (-x, 1 + y) in a square of the side 0.2: ρ (1 + y) along y. No mass is given off.
  const auto bent = [](const Point& x) { return Point{-x[0], 1 + x[1], 0}; };
  const double momentum = density * 0.2 * 0.2;
  CHECK(steady(settings, mesh, {density, 0}, zero, bent) == Approx(momentum / (2 * pi * 3)).epsilon(1e-3));
  const auto uniform = [](const Point&) { return Point{3, 4, 0}; };
  CHECK(std::abs(steady(settings, mesh, {density, 0}, zero, uniform)) < 1e-12);
}

TEST_CASE("a mirror adds what its image would hear") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(2, 16));
  const auto at_rest = [](const Point&) { return Point{0, 0, 0}; };
  const auto pressure = [](const Point& x) { return 3 * x[0] - 2 * x[1] + x[0] * x[1] * x[1]; };
  const auto heard = [&](const Point& position, std::vector<acoustic::MirrorPlane> mirrors) {
    auto settings = microphone(SurfaceMethod::ffowcs_williams_hawkings, {"control"}, position);
    settings.mirrors = std::move(mirrors);
    return steady(settings, mesh, {density, 0}, pressure, at_rest);
  };
  const double direct = heard(far_away, {}), image = heard({far_away[0], -10 - far_away[1], 0}, {});
  CHECK(heard(far_away, {{.axis = 1, .position = -5}}) == Approx(direct + image).epsilon(1e-6));
}

TEST_CASE("what cannot be heard is refused on every rank") {
  using Catch::Matchers::Contains;
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(2, 16));
  const auto make = [&](const SurfaceMicrophoneSettings& settings) {
    SurfaceMicrophone(mesh, fluid(mesh), {density, 0}, settings, {1e-4, 0.1});
  };
  const auto curle = SurfaceMethod::curle, fwh = SurfaceMethod::ffowcs_williams_hawkings;
  CHECK_NOTHROW(make(microphone(curle, {"body"}, far_away)));
  CHECK_NOTHROW(make(microphone(fwh, {"body"}, far_away)));
  CHECK_THROWS_WITH(make(microphone(curle, {"control"}, far_away)), Contains("solid walls"));
  CHECK_THROWS_WITH(make(microphone(fwh, {"half"}, far_away)), Contains("parts the flow"));
  CHECK_THROWS_WITH(make(microphone(fwh, {"control"}, {0.01, 0.02, 0})), Contains("inside"));
  CHECK_THROWS_WITH(make(microphone(fwh, {"control"}, {0.11, 0.02, 0})), Contains("time steps of sound"));
  CHECK_THROWS_WITH(make(microphone(fwh, {"left"}, far_away)), Contains("closed"));
  CHECK_THROWS_WITH(make(microphone(fwh, {"left", "right", "bottom", "top"}, far_away)), Contains("flow inside"));
  auto behind = microphone(fwh, {"control"}, far_away);
  behind.mirrors = {{.axis = 0, .position = 1}};
  CHECK_THROWS_WITH(make(behind), Contains("mirror"));
}

TEST_CASE("a microphone goes on from its state to the last bit") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, box_around_a_body(2, 8));
  const auto settings = microphone(SurfaceMethod::ffowcs_williams_hawkings, {"control"}, far_away);
  const Sound sound = monopole(2, 1, c);
  const double dt = period / 20;
  const auto make = [&] { return SurfaceMicrophone(mesh, fluid(mesh), {density, 0}, settings, {dt, 6 * period}); };
  SurfaceMicrophone one = make(), other = make();
  // Steps of the flow that are no multiples of the interval; sound is on its way for 44 of them.
  const auto time = [&](int n) { return (n + 0.3 * (n % 2)) * dt; };
  for (int n = 1; n < 116; ++n) {
    const FlowSnapshot before = snapshot(mesh, sound, time(n - 1)), now = snapshot(mesh, sound, time(n));
    const double heard = one.follow(before, now);
    if (n == 32) other.set_state(one.state());
    if (n > 32) CHECK(other.follow(before, now) == heard);
  }
}
