#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/base/mpi.hpp"
#include "tests/coupling/made_flow.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using test::MadeFlow;
using test::Point;

// A flow of even vorticity ω = -γ, which moves with the air and so stays what it is, beside any potential flow:
//
//   u = (γ y, 0) + a(t) ∇φ,   φ = cosh(κ y) sin(κ x + δ),   p_ic = -ρ (a' φ + |u|² / 2 + ω Ψ),
//
// Ψ its stream function: an exact unsteady solution of Euler's equations, whose rim lets it in and out as given, and is
// rigid to sound. div div(u u) has steady, linear (γ a) and quadratic (a²) parts.
namespace {

constexpr double density = 1.2, shear = 1, kappa = 2, shift = 0.3, centre = 2, width = 0.45, amplitude = 0.2;

double a(double t) { return amplitude * std::exp(-std::pow((t - centre) / width, 2)); }
double rate_of_a(double t) { return -2 * (t - centre) / (width * width) * a(t); }

Point velocity(const Point& x, double t) {
  return {shear * x[1] + a(t) * kappa * std::cosh(kappa * x[1]) * std::cos(kappa * x[0] + shift),
          a(t) * kappa * std::sinh(kappa * x[1]) * std::sin(kappa * x[0] + shift), 0};
}

double pressure(const Point& x, double t) {
  const Point u = velocity(x, t);
  const double potential = std::cosh(kappa * x[1]) * std::sin(kappa * x[0] + shift);
  const double stream = 0.5 * shear * x[1] * x[1] + a(t) * std::sinh(kappa * x[1]) * std::cos(kappa * x[0] + shift);
  return -density * (rate_of_a(t) * potential + 0.5 * (u[0] * u[0] + u[1] * u[1]) - shear * stream);
}

/// The inside of the mesh swings.
Point swing(const Point& x, double t) {
  const double bump = 0.04 * std::sin(M_PI * x[0]) * std::sin(2 * M_PI * x[1]) * std::sin(2 * M_PI * t);
  return {bump, -0.5 * bump, 0};
}

/// p_a of each analogy at time `end`, and p_ic, at all vertices that this rank owns.
struct Sounds {
  std::vector<std::vector<double>> p_a;
  std::vector<double> p_ic;
};

struct Room {
  double speed_of_sound = 1;  ///< [m/s]
  double fade_in = 0;         ///< [s] of the sources
  bool swings = false;        ///< its mesh
  bool releases = false;      ///< sound at its right end: p_a = 0, so that the pressure there is the flow's
};

Sounds sounds_of(const std::vector<std::string>& analogies, int cells, const Room& room) {
  const auto scene = test::box_scene({1, 0.5, 0}, {cells, cells / 2, 0}, [](const auto&) { return RegionKind::fluid; });
  const double dt = 0.5 / cells, end = 2.75;
  Case config;
  config.flow.emplace();
  std::vector<std::unique_ptr<Voice>> owners;
  std::vector<Voice*> voices;
  for (const std::string& analogy : analogies) {
    acoustic::AcousticSettings settings;
    settings.density = density;
    settings.speed_of_sound = room.speed_of_sound;
    settings.step = dt;
    settings.solver_tolerance = 1e-10;
    settings.analogy.name = analogy;
    settings.analogy.fade_in = room.fade_in;
    if (room.releases) settings.boundaries = {{"right", acoustic::AcousticBoundaryKind::pressure_release}};
    owners.push_back(std::make_unique<Voice>(*scene, config, settings));
    voices.push_back(owners.back().get());
  }
  MadeFlow flow = {pressure, velocity, {}};
  if (room.swings) flow.displacement = swing;
  test::Lead lead(*scene, flow, dt);
  while (lead.time() < end - dt / 2) lead.step(voices);
  Sounds result;
  const std::int32_t owned = scene->flow->mesh.vertices.num_owned;
  // All is fluid and nothing is stripped, so that the vertices of air and flow are the same.
  result.p_ic = lead.history().snapshots().back().pressure;
  result.p_ic.resize(owned);
  for (Voice* voice : voices) {
    result.p_a.push_back(voice->pressure().values);
    result.p_a.back().resize(owned);
  }
  return result;
}

double rms(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value * value;
  return std::sqrt(base::sum(MPI_COMM_WORLD, sum) / base::sum(MPI_COMM_WORLD, static_cast<double>(values.size())));
}

std::vector<double> combined(const std::vector<double>& p, double factor, const std::vector<double>& q) {
  std::vector<double> result = p;
  for (std::size_t i = 0; i < p.size(); ++i) result[i] += factor * q[i];
  return result;
}

/// Largest minus smallest.
double range(const std::vector<double>& values) {
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  return base::largest(MPI_COMM_WORLD, *highest) + base::largest(MPI_COMM_WORLD, -*lowest);
}

/// rms of the difference of the first two analogies' pressures over that of the pressure.
double difference(const Sounds& sounds) {
  return rms(combined(sounds.p_a[1], -1, sounds.p_a[0])) / rms(combined(sounds.p_a[0], 1, sounds.p_ic));
}

/// The same for differences of pressure between two places. In a closed room the mean pressure is what its rim has let
/// in, and |u|² and p through the rim are let in by one analogy and not by the other.
double difference_but_for_mean(const Sounds& sounds) {
  return range(combined(sounds.p_a[1], -1, sounds.p_a[0])) / range(combined(sounds.p_a[0], 1, sounds.p_ic));
}

}  // namespace

TEST_CASE("Lighthill's pressure is that of the pressure's rate, with an error of second order in h") {
  for (const Room& room : {Room{}, {.swings = true}, {.releases = true}, {.swings = true, .releases = true}}) {
    const Sounds coarse = sounds_of({"pressure_rate", "lighthill"}, 16, room);
    const Sounds fine = sounds_of({"pressure_rate", "lighthill"}, 32, room);
    const double error_coarse = difference(coarse), error_fine = difference(fine);
    // The sound is as large as the flow's pressure, so that they agree in both.
    const double part = rms(fine.p_a[0]) / rms(fine.p_ic);
    CAPTURE(room.swings, room.releases, error_coarse, error_fine, part);
    if (base::rank(MPI_COMM_WORLD) == 0) {
      std::printf("lighthill - pressure_rate: %.3g %.3g order %.2f, p_a / p_ic %.2g\n", error_coarse, error_fine,
                  std::log2(error_coarse / error_fine), part);
    }
    CHECK(part > 0.5);
    CHECK(error_fine < 0.01);
    CHECK(std::log2(error_coarse / error_fine) > 1.8);
  }
}

TEST_CASE("pcwe tends to pressure_rate, and vortex to lighthill, as the square of the Mach number") {
  for (const auto& pair : {std::vector<std::string>{"pressure_rate", "pcwe"}, {"lighthill", "vortex"}}) {
    std::vector<double> differences;
    // Sources rise in time 1: half the square of the shear flow's speed is there from the start, and would ring for
    // ever.
    for (const double speed_of_sound : {10.0, 20.0, 40.0}) {
      differences.push_back(
          difference_but_for_mean(sounds_of(pair, 16, {.speed_of_sound = speed_of_sound, .fade_in = 1})));
    }
    CAPTURE(pair, differences);
    if (base::rank(MPI_COMM_WORLD) == 0) {
      std::printf("%s - %s: %.3g %.3g %.3g exponents %.2f %.2f\n", pair[1].c_str(), pair[0].c_str(), differences[0],
                  differences[1], differences[2], std::log2(differences[0] / differences[1]),
                  std::log2(differences[1] / differences[2]));
    }
    CHECK(differences[0] > 1e-5);
    CHECK(differences[2] < 0.01);
    CHECK(std::log2(differences[0] / differences[1]) == Approx(2).margin(0.2));
    CHECK(std::log2(differences[1] / differences[2]) == Approx(2).margin(0.2));
  }
}
