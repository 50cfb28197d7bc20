#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "acoustic_solver/microphones.hpp"
#include "acoustic_solver/pulse.hpp"
#include "acoustic_solver/signals/spectrum.hpp"
#include "core/base/mpi.hpp"
#include "tests/verification/acoustic_fields.hpp"
#include "transfer/strip.hpp"

namespace vocalis::acoustic::verification {
namespace {

constexpr double kSpeed = 350, kDensity = 1.14;
constexpr double kDuct = 0.01, kChamber = 0.5, kPipe = 0.1;  // [m] height of the duct; lengths of chamber and pipes

/// A plane duct above its symmetry line with a chamber `ratio` times as high: a box without what lies above the pipes.
transfer::StrippedMesh chamber(int ratio, int cells_across) {
  const double h = kDuct / cells_across, length = kChamber + 2 * kPipe;
  const mesh::Mesh box =
      box_mesh({length, ratio * kDuct, 0}, {static_cast<int>(length / h + 0.5), ratio * cells_across, 0});
  std::vector<std::int32_t> keep(box.num_cells());
  for (std::int32_t cell = 0; cell < box.num_cells(); ++cell) {
    double x = 0, y = 0;
    for (const std::int32_t v : box.vertices_of(cell)) x += box.point(v)[0] / 3, y += box.point(v)[1] / 3;
    keep[cell] = y < kDuct || (x > kPipe && x < kPipe + kChamber);
  }
  return transfer::strip(box, keep);
}

struct Peak {
  double loss = 0;       ///< [dB]
  double frequency = 0;  ///< [Hz]
};

/// The largest transmission loss around c / 4L, on rank 0. The left end is open and driven, so that the incident wave
/// is ρ c g / 2; the right end is open.
Peak largest_loss(int ratio, int cells_across) {
  const transfer::StrippedMesh stripped = chamber(ratio, cells_across);
  const mesh::Mesh& mesh = stripped.mesh;
  const double dt = 1e-4, h = kDuct / cells_across;
  AcousticSettings settings;
  settings.speed_of_sound = kSpeed;
  settings.density = kDensity;
  settings.step = dt;
  settings.boundaries = {{"left", AcousticBoundaryKind::open}, {"right", AcousticBoundaryKind::open}};
  AcousticSolver solver(mesh, settings);
  const GaussianFlux pulse({.amplitude = 1, .maximum_frequency = 1000});
  const auto driven = [&](double t) {
    fem::Load load(solver.space(), 1);
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      const double* x = mesh.point(v);
      const bool at_end = x[1] < 1e-9 || x[1] > kDuct - 1e-9;
      if (x[0] < 1e-9) load.values[v] = pulse.value(t) * h * (at_end ? 0.5 : 1);
    }
    return load;
  };
  Microphones microphones(mesh, {{"behind", {kChamber + 2 * kPipe - 0.005, 0.004, 0}}});
  std::vector<double> incident;
  for (int n = 0; n * dt < 0.12; ++n) {
    const auto begin = driven(n * dt), end = driven((n + 1) * dt);
    CHECK(solver.advance(dt, {}, {&begin, &end, {}}).converged);
    microphones.sample(solver.state().time, solver.state().p);
    incident.push_back(0.5 * kDensity * kSpeed * pulse.value(solver.state().time));
  }
  const auto block = microphones.collect();
  Peak peak;
  if (base::rank(mesh.comm) != 0) return peak;
  const ComplexSpectrum transfer = transient_transfer_function(incident, block.values, 1 / dt, 0.5);
  for (std::size_t i = 0; i < transfer.frequency.size(); ++i) {
    if (transfer.frequency[i] < 100 || transfer.frequency[i] > 250) continue;
    const double loss = -20 * std::log10(std::abs(transfer.value[i]));
    if (loss > peak.loss) peak = {loss, transfer.frequency[i]};
  }
  return peak;
}

}  // namespace

TEST_CASE("an expansion chamber holds back what plane waves say") {
  // TL = 10 log10(1 + (m - 1/m)² sin²(kL) / 4), greatest at kL = π / 2. The steps' evanescent waves make the pipes
  // longer by δ of about their height, which changes the peak by some 10 log10(1 + 2 k²δ²), below 0.02 dB here.
  for (const int ratio : {2, 4, 9, 16, 25}) {
    const double plane = 10 * std::log10(1 + std::pow(ratio - 1.0 / ratio, 2) / 4);
    const Peak coarse = largest_loss(ratio, 1), fine = largest_loss(ratio, 2);
    if (base::rank(MPI_COMM_WORLD) != 0) continue;
    fmt::print("  expansion chamber, ratio {:2}: plane waves {:.3f} dB, computed {:.3f} {:.3f} dB at {} Hz\n", ratio,
               plane, coarse.loss, fine.loss, fine.frequency);
    CHECK(std::abs(fine.loss - plane) < 0.1);
    CHECK(std::abs(fine.frequency - kSpeed / (4 * kChamber)) < 10);
  }
}

}  // namespace vocalis::acoustic::verification
