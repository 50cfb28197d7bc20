#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

using std::numbers::pi;
constexpr double kSpeed = 350, kDensity = 1.14;
constexpr double kSize = 0.2;                              // [m] edge of the box; the source is at its corner
constexpr double kNearest = 0.05, kFarthest = 0.1;         // [m] from the source: where the field is compared
constexpr double kEnd = (2 * kSize - kFarthest) / kSpeed;  // [s] before the first echo comes
constexpr double kWidth = 1e-4, kPeak = 5e-4;              // [s] of the Gaussian in time

double gaussian(double t) { return std::exp(-std::pow((t - kPeak) / kWidth, 2) / 2); }
double rate(double t) { return -(t - kPeak) / (kWidth * kWidth) * gaussian(t); }
double integral(double t) {
  return kWidth * std::sqrt(pi / 2) * (1 + std::erf((t - kPeak) / (kWidth * std::numbers::sqrt2)));
}

double distance(std::span<const double> x) {
  return x.size() == 3 ? std::hypot(x[0], x[1], x[2]) : std::hypot(x[0], x[1]);
}

/// A load of one number at the vertex that lies at `point`.
fem::Load load_at(const fem::Space& space, std::array<double, 3> point, double value) {
  fem::Load load(space, 1);
  const mesh::Mesh& mesh = *space.mesh;
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    double away = 0;
    for (int k = 0; k < mesh.dimension; ++k) away = std::max(away, std::abs(mesh.point(v)[k] - point[k]));
    if (away < 1e-9) load.values[v] = value;
  }
  return load;
}

/// One source in a corner of a box with rigid planes of symmetry, which hold 1 / 2^dimension of it.
struct PointSource {
  int dimension = 3;
  bool is_dipole = false;                ///< along x: then the plane x = 0 is one of antisymmetry, p = 0
  std::function<double(double)> factor;  ///< of the load at the vertex, for cells of edge h
  SpaceTime exact;
};

/// |p - exact| / |exact| over the vertices of a shell on the planes y = 0 and y = x (they tell as much as all), and
/// times.
double error_of(const PointSource& source, int cells) {
  const int d = source.dimension;
  const double h = kSize / cells, dt = 0.5 * h / kSpeed;
  const mesh::Mesh mesh = box_mesh({kSize, kSize, d == 3 ? kSize : 0}, {cells, cells, cells});
  AcousticSettings settings;
  settings.speed_of_sound = kSpeed;
  settings.density = kDensity;
  settings.step = dt;
  if (source.is_dipole) settings.boundaries = {{"left", AcousticBoundaryKind::pressure_release}};
  AcousticSolver solver(mesh, settings);
  const std::array<double, 3> place = {source.is_dipole ? h : 0, 0, 0};
  // The x component of ∇q at the origin is (q(h) - q(-h)) / 2h; the half with x < 0 is not here.
  const double share = source.is_dipole ? 1 / (2 * h) / std::pow(2, d - 1) : 1 / std::pow(2, d);
  double difference = 0, scale = 0;
  for (int n = 0; (n + 1) * dt < kEnd; ++n) {
    const auto begin = load_at(solver.space(), place, share * source.factor(n * dt));
    const auto end = load_at(solver.space(), place, share * source.factor((n + 1) * dt));
    CHECK(solver.advance(dt, {}, {&begin, &end, {}}).converged);
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const std::span<const double> x(mesh.point(v), d);
      const double r = distance(x);
      const bool on_plane = x[1] < 1e-9 || std::abs(x[1] - x[0]) < 1e-9;
      if (r < kNearest || r > kFarthest || !on_plane) continue;
      const double exact = source.exact(x, solver.state().time);
      difference += std::pow(solver.state().p[v] - exact, 2);
      scale += exact * exact;
    }
  }
  return std::sqrt(base::sum(mesh.comm, difference) / base::sum(mesh.comm, scale));
}

void check_order(const char* title, const PointSource& source, const std::vector<int>& levels, double last_error) {
  std::vector<double> errors;
  for (const int cells : levels) errors.push_back(error_of(source, cells));
  print_errors(title, errors);
  CHECK(lowest_order(errors) > 1.5);
  CHECK(errors.back() < last_error);
}

}  // namespace

TEST_CASE("a point source of volume in space sounds as ρ Q'(t - r/c) / 4πr") {
  check_order("3-D monopole, pressure",
              {3, false, gaussian,
               [](auto x, double t) { return kDensity * rate(t - distance(x) / kSpeed) / (4 * pi * distance(x)); }},
              {10, 20, 40}, 0.015);
}

TEST_CASE("a point force in space sounds as a dipole") {
  // -∇·(F δ) drives p; the volume source of the same sound is minus the divergence of ∫F dt / ρ.
  check_order("3-D dipole, pressure",
              {3, true, [](double t) { return integral(t) / kDensity; },
               [](auto x, double t) {
                 const double r = distance(x), at = t - r / kSpeed;
                 return x[0] / r / (4 * pi) * (rate(at) / (kSpeed * r) + gaussian(at) / (r * r));
               }},
              {10, 20, 40}, 0.03);
}

TEST_CASE("a line source in the plane leaves a wake behind its front") {
  // p = (ρ / 2π) ∫ Q'(t - (r/c) cosh s) ds over s > 0: the Green function of the plane with τ = (r/c) cosh s.
  check_order("2-D line monopole, pressure",
              {2, false, gaussian,
               [](auto x, double t) {
                 const double travel = distance(x) / kSpeed, ds = 0.02;
                 double sum = 0.5 * rate(t - travel);
                 for (int i = 1; travel * std::cosh(i * ds) < t; ++i) sum += rate(t - travel * std::cosh(i * ds));
                 return kDensity / (2 * pi) * sum * ds;
               }},
              {24, 48, 96}, 0.003);
}

}  // namespace vocalis::acoustic::verification
