#include <catch2/catch.hpp>
#include <cmath>

#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"
#include "transfer/point_interpolation.hpp"

namespace vocalis::acoustic::verification {
namespace {

constexpr double kSpeed = 350, kDensity = 1.14, kLength = 0.17;
constexpr double kWidth = 0.2e-3, kDelay = 1.2e-3;

// The glottis blows u(t) into a duct; the incompressible pressure is p_ic = ρ u'(t) (L - x) for x < L, and 0 beyond.
double glottal_velocity(double t) { return std::exp(-std::pow((t - kDelay) / kWidth, 2)); }
double first_rate(double t) { return -2 * (t - kDelay) / (kWidth * kWidth) * glottal_velocity(t); }
double second_rate(double t) {
  const double s = (t - kDelay) / kWidth;
  return (4 * s * s - 2) / (kWidth * kWidth) * glottal_velocity(t);
}
double incompressible(double x, double t) { return x < kLength ? kDensity * first_rate(t) * (kLength - x) : 0; }

/// Sums of squares of p_a + p_ic - reference, and of the reference, over vertices and times.
struct Difference {
  double square = 0, scale = 0;
  void add(const mesh::Mesh& mesh, const std::vector<double>& sound, const std::function<double(std::int32_t)>& exact) {
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      square += std::pow(sound[v] - exact(v), 2);
      scale += std::pow(exact(v), 2);
    }
  }
  double relative(const mesh::Mesh& mesh) const {
    return std::sqrt(base::sum(mesh.comm, square) / base::sum(mesh.comm, scale));
  }
};

AcousticSettings air(double step) {
  AcousticSettings settings;
  settings.speed_of_sound = kSpeed;
  settings.density = kDensity;
  settings.step = step;
  return settings;
}

/// Pressure of vertex v with the incompressible part added.
std::vector<double> total(const AcousticSolver& solver, const mesh::Mesh& mesh) {
  std::vector<double> result = solver.state().p;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v)
    result[v] += incompressible(mesh.point(v)[0], solver.state().time);
  return result;
}

/// -(1 / (ρ c²)) (∂t p_ic, q), plus <u, q> where the flow ends, at x = L. `sign` -1 is what mass conservation gives.
fem::Load pressure_rate(const fem::Space& space, double time, double sign, bool with_outlet, double height, double h) {
  const mesh::Mesh& mesh = *space.mesh;
  const double tolerance = 1e-9;
  // Cells end at x = L: a quadrature point is on one side.
  fem::Load load = load_of(
      space, mesh.coordinates,
      [&](auto x, double t) {
        return x[0] < kLength ? sign * second_rate(t) * (kLength - x[0]) / (kSpeed * kSpeed) : 0;
      },
      time);
  if (!with_outlet) return load;
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    if (std::abs(mesh.point(v)[0] - kLength) > tolerance) continue;
    const double y = mesh.point(v)[1];
    const bool at_end = y < tolerance || y > height - tolerance;
    load.values[v] += glottal_velocity(time) * h * (at_end ? 0.5 : 1);
  }
  return load;
}

/// The flow's part of the duct on a mesh with cells and a partition of its own, `cells` along it and three across.
class OtherMesh {
 public:
  OtherMesh(const mesh::Mesh& air, int cells, double height)
      : mesh_(box_mesh({kLength, height, 0}, {cells, 3, 0})),
        space_(fem::lagrange(mesh_, 1)),
        at_flow_(air, mesh_.coordinates),
        height_(height) {
    CHECK(at_flow_.outside().count == 0);
  }
  /// `pressure_rate` there, carried over to the air.
  fem::Load load(const fem::Space& air, double time, double sign, bool with_outlet) const {
    const fem::Load given = pressure_rate(space_, time, sign, with_outlet, height_, height_ / 3);
    fem::Load result(air, 1);
    at_flow_.restrict_to(given.values, result);
    return result;
  }

 private:
  mesh::Mesh mesh_;
  fem::Space space_;
  transfer::PointInterpolation at_flow_;
  double height_;
};

using SourceAt = std::function<fem::Load(const fem::Space&, double time)>;

/// Against direct acoustics of a duct of the flow's length, with p = 0 at its end.
double difference_with_release(const mesh::Mesh& mesh, double dt, const SourceAt& source) {
  AcousticSettings blown = air(dt), analogy = air(dt);
  analogy.boundaries = {{"right", AcousticBoundaryKind::pressure_release}};
  blown.boundaries = {{"right", AcousticBoundaryKind::pressure_release}, {"left", AcousticBoundaryKind::flux}};
  AcousticSolver direct(mesh, blown), sound(mesh, analogy);
  const Source flux = {nullptr, nullptr, glottal_velocity};
  Difference difference;
  for (int n = 0; n * dt < 6e-3; ++n) {
    const fem::Load begin = source(sound.space(), n * dt), end = source(sound.space(), (n + 1) * dt);
    CHECK(direct.advance(dt, {}, flux).converged);
    CHECK(sound.advance(dt, {}, {&begin, &end, {}}).converged);
    difference.add(mesh, total(sound, mesh), [&](std::int32_t v) { return direct.state().p[v]; });
  }
  return difference.relative(mesh);
}

double duct_with_release(int cells, double sign) {
  const double h = kLength / cells;
  return difference_with_release(
      box_mesh({kLength, 2 * h, 0}, {cells, 2, 0}), 0.5 * h / kSpeed,
      [&](const fem::Space& space, double time) { return pressure_rate(space, time, sign, false, 2 * h, h); });
}

double duct_with_release_on_two_meshes(int cells, int flow_cells) {
  const double h = kLength / cells;
  const mesh::Mesh mesh = box_mesh({kLength, 2 * h, 0}, {cells, 2, 0});
  const OtherMesh flow(mesh, flow_cells, 2 * h);
  return difference_with_release(
      mesh, 0.5 * h / kSpeed, [&](const fem::Space& space, double time) { return flow.load(space, time, -1, false); });
}

/// Against the wave that travels on through a duct longer than the flow.
double difference_going_on(const mesh::Mesh& mesh, double dt, const SourceAt& source) {
  AcousticSettings settings = air(dt);
  settings.boundaries = {{"right", AcousticBoundaryKind::open}};
  AcousticSolver sound(mesh, settings);
  Difference difference;
  for (int n = 0; n * dt < 4e-3; ++n) {
    const fem::Load begin = source(sound.space(), n * dt), end = source(sound.space(), (n + 1) * dt);
    CHECK(sound.advance(dt, {}, {&begin, &end, {}}).converged);
    const double t = sound.state().time;
    difference.add(mesh, total(sound, mesh),
                   [&](std::int32_t v) { return kDensity * kSpeed * glottal_velocity(t - mesh.point(v)[0] / kSpeed); });
  }
  return difference.relative(mesh);
}

double duct_that_goes_on(int cells, bool with_outlet) {
  const double h = 2 * kLength / cells;
  return difference_going_on(
      box_mesh({2 * kLength, 2 * h, 0}, {cells, 2, 0}), 0.5 * h / kSpeed,
      [&](const fem::Space& space, double time) { return pressure_rate(space, time, -1, with_outlet, 2 * h, h); });
}

/// The air goes on to 1.9 L, so that the flow ends inside of a cell.
double duct_that_goes_on_over_another_mesh(int cells, int flow_cells, bool with_outlet) {
  const double length = 1.9 * kLength, h = length / cells;
  const mesh::Mesh mesh = box_mesh({length, 2 * h, 0}, {cells, 2, 0});
  const OtherMesh flow(mesh, flow_cells, 2 * h);
  return difference_going_on(mesh, 0.5 * h / kSpeed, [&](const fem::Space& space, double time) {
    return flow.load(space, time, -1, with_outlet);
  });
}

}  // namespace

TEST_CASE("V3: incompressible plus acoustic pressure equals direct acoustics of a duct, with the minus sign") {
  std::vector<double> errors;
  for (const int cells : {50, 100, 200}) errors.push_back(duct_with_release(cells, -1));
  print_errors("V3 duct, p_ic + p_a against direct acoustics", errors);
  CHECK(lowest_order(errors) == Approx(2).margin(0.2));
  CHECK(errors.back() < 1e-3);
  CHECK(duct_with_release(50, 1) > 1.5);
}

TEST_CASE("V4: where the flow ends inside of the sound, its outlet's flux carries the sound on") {
  std::vector<double> errors;
  for (const int cells : {100, 200, 400}) errors.push_back(duct_that_goes_on(cells, true));
  print_errors("V4 duct that goes on, with the outlet's flux", errors);
  CHECK(lowest_order(errors) == Approx(2).margin(0.2));
  CHECK(errors.back() < 1e-3);
  CHECK(duct_that_goes_on(100, false) > 0.5);
}

// Seven flow cells to five of the air, which no vertices but those of the ends have in common.
TEST_CASE("V3 and V4 hold where the flow has a finer mesh of its own") {
  std::vector<double> released, going_on;
  for (const int level : {1, 2, 4}) {
    released.push_back(duct_with_release_on_two_meshes(25 * level, 35 * level));
    going_on.push_back(duct_that_goes_on_over_another_mesh(50 * level, 37 * level, true));
  }
  print_errors("V3 duct, flow on a mesh of its own", released);
  print_errors("V4 duct that goes on, flow on a mesh of its own", going_on);
  CHECK(lowest_order(released) == Approx(2).margin(0.2));
  CHECK(lowest_order(going_on) == Approx(2).margin(0.2));
  CHECK(released.back() < 1e-3);
  CHECK(going_on.back() < 1e-3);
  CHECK(duct_that_goes_on_over_another_mesh(50, 37, false) > 0.5);
}

}  // namespace vocalis::acoustic::verification
