#include "acoustic_solver/far_field.hpp"

#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/balls.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

using Point = std::array<double, 3>;
using Sound = std::function<double(const Point&, double)>;

constexpr double speed = 350, density = 1.2, width = 0.15e-3, delay = 0.7e-3, radius = 0.1;

double pulse(double t) { return std::exp(-std::pow((t - delay) / width, 2)); }
double pulse_rate(double t) { return -2 * (t - delay) / (width * width) * pulse(t); }

/// Distance and direction from a source to a point.
struct Ray {
  double length;
  Point direction;
};
Ray ray(const Point& from, const Point& to) {
  const Point d = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double length = std::hypot(d[0], d[1], d[2]);
  return {length, {d[0] / length, d[1] / length, d[2] / length}};
}

/// p = ρ Q̇(t - r/c) / (4π r), Q̇ a pulse.
double monopole(const Point& source, const Point& x, double t) {
  const double r = ray(source, x).length;
  return density * pulse(t - r / speed) / (4 * std::numbers::pi * r);
}
/// p = cos θ / (4π) (Ḟ / (c r) + F / r²) at t - r/c, F a pulse along z.
double dipole(const Point& source, const Point& x, double t) {
  const auto [r, direction] = ray(source, x);
  const double late = t - r / speed;
  return direction[2] / (4 * std::numbers::pi) * (pulse_rate(late) / (speed * r) + pulse(late) / (r * r));
}

const Point off_centre = {0.015, -0.01, 0.02};
const Sound off_centre_monopole = [](const Point& x, double t) { return monopole(off_centre, x, t); };
const Sound off_centre_dipole = [](const Point& x, double t) { return dipole(off_centre, x, t); };

MicrophoneSettings microphone(const Point& position, const std::string& surface = "open",
                              std::vector<MirrorPlane> mirrors = {}) {
  return {"far", position, MicrophoneKind::far_field, surface, std::move(mirrors)};
}

std::vector<std::int32_t> cells_near(const mesh::Mesh& mesh, const Point& point, double distance) {
  std::vector<std::int32_t> result(mesh.num_cells(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      const double* x = mesh.point(v);
      if (ray(point, {x[0], x[1], x[2]}).length < distance) result[cell] = 1;
    }
  }
  return result;
}

/// Largest error over time and microphones, each relative to the largest exact pressure there, of an exact sound that
/// the surface is told. Sub-steps alternate between dt and `unevenness` dt.
double error(const mesh::Mesh& mesh, const std::vector<MicrophoneSettings>& microphones, const Sound& sound, double dt,
             double unevenness = 1) {
  FarField far(mesh, microphones, {speed, dt, cells_near(mesh, off_centre, 0.03)});
  std::vector<double> worst(microphones.size()), scale(microphones.size());
  std::vector<double> values(mesh.num_vertices());
  double longest = 0;
  for (const auto& one : microphones) longest = std::max(longest, ray({0, 0, 0}, one.position).length);
  double time = 0;
  for (int n = 1; time < longest / speed + 2.5 * delay; ++n) {
    time += n % 2 ? dt : unevenness * dt;
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      const double* x = mesh.point(v);
      const bool is_near = ray(off_centre, {x[0], x[1], x[2]}).length < 0.01;
      values[v] = is_near || time > 3 * delay ? 0 : sound({x[0], x[1], x[2]}, time);
    }
    far.sample(time, values);
    for (std::size_t m = 0; m < microphones.size(); ++m) {
      const double here = sound(microphones[m].position, time);
      const double heard = base::sum(mesh.comm, far.pressure(m, time));
      worst[m] = std::max(worst[m], std::abs(heard - here));
      scale[m] = std::max(scale[m], std::abs(here));
    }
  }
  double result = 0;
  for (std::size_t m = 0; m < microphones.size(); ++m) result = std::max(result, worst[m] / scale[m]);
  return result;
}

double step_of(double h) { return 0.5 * h / speed; }

}  // namespace

TEST_CASE("sound beyond a sphere follows from the pressure along it, to second order") {
  for (const Sound& sound : {off_centre_monopole, off_centre_dipole}) {
    std::vector<double> errors;
    for (const int cells : {8, 16}) {
      const mesh::Mesh mesh = test::ball(radius, cells);
      errors.push_back(error(mesh, {microphone({0.36, 0.48, 0.8})}, sound, step_of(2 * radius / cells)));
    }
    CAPTURE(errors[0], errors[1]);
    CHECK(errors[1] < 0.02);
    CHECK(std::log2(errors[0] / errors[1]) > 1.8);
  }
}

TEST_CASE("sound beyond a sphere: table of errors", "[.table]") {
  for (const auto& [name, sound] : {std::pair{"monopole", off_centre_monopole}, {"dipole", off_centre_dipole}}) {
    for (const double distance : {1.0, 5.0}) {
      for (const int cells : {8, 16, 32}) {
        const mesh::Mesh mesh = test::ball(radius, cells);
        const std::vector<MicrophoneSettings> there = {microphone({0.36 * distance, 0.48 * distance, 0.8 * distance})};
        const double worst = error(mesh, there, sound, step_of(2 * radius / cells));
        if (base::rank(mesh.comm) == 0) std::printf("%s %g m, %d cells: %.2e\n", name, distance, cells, worst);
      }
    }
  }
}

TEST_CASE("a surface inside the mesh sends to the side without sources") {
  const mesh::Mesh mesh = test::ball(2 * radius, 16);
  const double outer = error(mesh, {microphone({0, 0, 0.5}, "open")}, off_centre_monopole, step_of(0.025));
  const double inner = error(mesh, {microphone({0, 0, 0.5}, "control")}, off_centre_monopole, step_of(0.025));
  CAPTURE(outer, inner);
  CHECK(outer < 0.05);
  CHECK(inner < 0.05);
}

TEST_CASE("a half sphere and its image hear a source before a baffle") {
  const mesh::Mesh mesh = test::ball(radius, 16, true);
  const auto both = [](const Point& x, double t) {
    return monopole(off_centre, x, t) + monopole({off_centre[0], off_centre[1], -off_centre[2]}, x, t);
  };
  const std::vector<MirrorPlane> baffle = {{2, 0}};
  CHECK(error(mesh, {microphone({0.6, 0, 0.8}, "open", baffle), microphone({0, 1, 0}, "open", baffle)}, both,
              step_of(radius / 8)) < 0.015);
}

TEST_CASE("sub-steps need not be equal") {
  const mesh::Mesh mesh = test::ball(radius, 16);
  const std::vector<MicrophoneSettings> there = {microphone({0, 0, 0.5})};
  const double dt = step_of(radius / 8);
  const double even = error(mesh, there, off_centre_monopole, dt);
  CHECK(error(mesh, there, off_centre_monopole, dt, 0.37) < 1.02 * even);
}

TEST_CASE("a far field goes on from a state as if it had been there all the time") {
  const mesh::Mesh mesh = test::ball(radius, 8);
  const std::vector<MicrophoneSettings> there = {microphone({0, 0, 0.5}), microphone({0.3, 0.1, 0.2})};
  const double dt = step_of(radius / 4);
  FarField one(mesh, there, {speed, dt, {}}), other(mesh, there, {speed, dt, {}});
  std::vector<double> values(mesh.num_vertices());
  double heard = 0;
  for (int n = 1; n < 120; ++n) {
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) values[v] = std::sin(0.2 * n + mesh.point(v)[0]);
    one.sample(n * dt, values);
    if (n == 60) other.set_state(one.state());
    if (n <= 60) continue;
    other.sample(n * dt, values);
    for (std::size_t m = 0; m < there.size(); ++m) {
      heard = std::max(heard, std::abs(one.pressure(m, n * dt)));
      CHECK(one.pressure(m, n * dt) == other.pressure(m, n * dt));
    }
  }
  CHECK(base::largest(mesh.comm, heard) > 0.01);  // a rank's part
}

TEST_CASE("a far field that cannot be is the user's mistake") {
  const mesh::Mesh whole = test::ball(radius, 8), half = test::ball(radius, 8, true);
  const mesh::Mesh plane = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {4, 4, 0}));
  const double dt = 1e-5;
  const auto far = [&](const mesh::Mesh& mesh, const MicrophoneSettings& one, std::vector<std::int32_t> sources = {}) {
    FarField(mesh, {one}, {speed, dt, std::move(sources)});
  };
  const auto says = [](const char* words) { return Catch::Contains(words); };
  CHECK_NOTHROW(far(whole, microphone({0, 0, 0.2})));
  CHECK_THROWS_WITH(far(whole, microphone({0, 0, 0.05})), says("inside"));
  CHECK_THROWS_WITH(far(whole, microphone({0, 0, 0.11})), says("10 intervals"));
  CHECK_THROWS_WITH(far(whole, microphone({0, 0, 0.2}, "sky")), says("use one of: open, control"));
  CHECK_THROWS_WITH(far(plane, microphone({0, 0, 0.2}, "left")), says("three dimensions"));
  CHECK_THROWS_WITH(far(half, microphone({0, 0, 0.2})), says("opening of 0.0"));
  CHECK_NOTHROW(far(half, microphone({0, 0, 0.2}, "open", {{2, 0}})));
  CHECK_THROWS_WITH(far(half, microphone({0, 0.2, -0.1}, "open", {{2, 0}})), says("behind"));
  CHECK_THROWS_WITH(far(half, microphone({0, 0, 0.2}, "open", {{2, 0.01}})), says("one side of its mirror z = 0.01 m"));
  CHECK_THROWS_WITH(far(half, microphone({0, 0, 0.2}, "baffle", {{2, 0}})), says("behind"));
  const auto middle = cells_near(whole, {0, 0, 0}, 0.02);
  CHECK_NOTHROW(far(whole, microphone({0, 0, 0.2}, "control"), middle));
  CHECK_THROWS_WITH(far(whole, microphone({0, 0, 0.2}, "control")), says("both on one side"));
  CHECK_THROWS_WITH(far(whole, microphone({0, 0, 0.2}), cells_near(whole, {0, 0, radius}, 0.02)), says("touches"));
  std::vector<double> moved = whole.coordinates;
  for (double& x : moved) x *= 1.01;
  const FarField still(whole, {microphone({0, 0, 0.2})}, {speed, dt, {}});
  CHECK_NOTHROW(still.require_still(whole, whole.coordinates));
  CHECK_THROWS_WITH(still.require_still(whole, moved), says("it moved by 0.001 m"));
}

}  // namespace vocalis::acoustic
