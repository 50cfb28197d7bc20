#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/microphones.hpp"
#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/ring_down.hpp"
#include "core/base/mpi.hpp"
#include "core/io/gmsh_reader.hpp"
#include "tests/verification/acoustic_fields.hpp"

namespace vocalis::acoustic::verification {
namespace {

/// The formants of a thin wedge of cases/vowel_i/tract.geo with such walls, on rank 0.
std::vector<Formant> formants_of(io::GeoValues values, AcousticBoundary walls) {
  values["wedge"] = 10.0;
  walls.group = "walls";
  const mesh::Mesh mesh = mesh::distribute(
      MPI_COMM_WORLD, io::mesh_geometry(MPI_COMM_WORLD, VOCALIS_SOURCE_DIR "/cases/vowel_i/tract.geo", values));
  AcousticSettings settings;
  settings.density = 1.14;
  settings.speed_of_sound = 350;
  settings.step = 1e-5;
  settings.boundaries = {{"glottis", AcousticBoundaryKind::flux}, walls, {"open", AcousticBoundaryKind::open, 0, 0.06}};
  AcousticSolver solver(mesh, settings);
  Microphones microphones(mesh, {{"inside", {0.002, 0.001, 0.0001}}});
  microphones.require_inside();
  const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 8000});
  std::vector<double> flux;
  const auto listen = [&](double t) {
    flux.push_back(pulse.value(t));
    microphones.sample(t, solver.state().p);
  };
  CHECK(solver.advance(0.02, {}, {nullptr, nullptr, [&](double t) { return pulse.value(t); }}, listen).converged);
  const auto block = microphones.collect();
  if (base::rank(mesh.comm) != 0) return {};
  return analyse_pulse_response(flux, block.values, 1 / settings.step, {}).formants;
}

AcousticBoundary admitting(double admittance) { return {"walls", AcousticBoundaryKind::admittance, admittance}; }

struct Expected {
  double frequency = 0, bandwidth = 0;  ///< [Hz]
};

void check_formants(const char* title, const std::vector<Formant>& found, const std::vector<Expected>& expected) {
  if (base::rank(MPI_COMM_WORLD) != 0) return;
  for (std::size_t i = 0; i < expected.size() && i < found.size(); ++i) {
    fmt::print("  {:40} F{} {:7.1f} ({:.1f}), one-dimensional {:7.1f} ({:.1f}) Hz\n", title, i + 1, found[i].frequency,
               found[i].bandwidth, expected[i].frequency, expected[i].bandwidth);
  }
  REQUIRE(found.size() >= expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CHECK(std::abs(found[i].frequency / expected[i].frequency - 1) < 0.025);
    if (expected[i].bandwidth > 10) CHECK(std::abs(found[i].bandwidth / expected[i].bandwidth - 1) < 0.15);
  }
}

}  // namespace

// The one-dimensional poles are those of tests/oracles/one_dimensional_tract.py with the case files: plane waves.

TEST_CASE("the round tract of /i/ has the formants of its one-dimensional model, and those of its walls' losses") {
  const io::GeoValues story = {{"size_factor", 1.4}};
  check_formants("Story, rigid", formants_of(story, admitting(0)),
                 {{225.9, 0.1}, {2496.6, 4.3}, {3181.9, 226.0}, {3916.2, 37.1}});
  check_formants("Story, wall admittance 0.005", formants_of(story, admitting(0.005)), {{223.9, 59.6}, {2496.6, 93.2}});
}

TEST_CASE("a wall admittance of 0.05 leaves no formant of /i/ below 4 kHz, 0.005 leaves them") {
  const auto below = [](const std::vector<Formant>& formants) {
    return std::count_if(formants.begin(), formants.end(),
                         [](const Formant& f) { return f.frequency < 4000 && f.bandwidth < 600; });
  };
  const io::GeoValues story = {{"size_factor", 2.0}};
  const auto sound = formants_of(story, admitting(0.005)), dull = formants_of(story, admitting(0.05));
  if (base::rank(MPI_COMM_WORLD) != 0) return;
  CHECK(below(sound) >= 3);
  CHECK(below(dull) == 0);
}

TEST_CASE("walls that yield as cheeks do lift F1 of /i/, those of a boundary layer lower and damp all") {
  const io::GeoValues story = {{"size_factor", 1.4}};
  const auto soft = formants_of(story, {"walls", AcousticBoundaryKind::yielding});
  check_formants("Story, yielding", soft, {{293.9, 25.1}, {2507.3, 4.7}, {3194.2, 227.7}, {3925.1, 37.2}});
  if (base::rank(MPI_COMM_WORLD) == 0) CHECK(std::abs(soft[0].frequency / 293.9 - 1) < 0.02);
  check_formants("Story, viscothermal", formants_of(story, {"walls", AcousticBoundaryKind::viscothermal}),
                 {{223.2, 5.3}, {2483.2, 31.0}, {3157.6, 264.8}, {3894.5, 80.3}});
}

TEST_CASE("any list of areas is a tract: a uniform one rings as a tube in a baffle") {
  const double area = std::numbers::pi * 1e-4;
  check_formants("uniform tract in a baffle",
                 formants_of({{"areas", std::vector<double>{area, area, area}},
                              {"stations", std::vector<double>{0, 0.05, 0.17}},
                              {"size_factor", 1.4}},
                             admitting(0)),
                 {{490.3, 2.4}, {1472.8, 20.7}, {2460.2, 52.9}, {3453.3, 93.5}});
}

}  // namespace vocalis::acoustic::verification
