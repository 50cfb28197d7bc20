#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "core/base/mpi.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic::test {
namespace {

using std::numbers::pi;

/// Energy after so many periods of a mesh that swings within a rigid box, over that before; at first p is noise. The
/// walls stand still: no work is done on the sound.
///
/// dt     [s]
/// swing  of the mesh [rad/s]
double growth(double spectral_radius, double dt, double swing, int periods) {
  const mesh::Mesh mesh = unit_box(MPI_COMM_WORLD, 2, 16);
  AcousticSettings settings = unit_medium(dt);
  settings.spectral_radius = spectral_radius;
  AcousticSolver solver(mesh, settings);
  State state;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(-1, 1);
  std::vector<double> of_all(mesh.vertices.num_global);
  for (double& value : of_all) value = noise(random);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) state.p.push_back(of_all[mesh.vertex_input[v]]);
  state.psi.assign(mesh.num_vertices(), 0.0);
  solver.set_state(state);
  const double before = solver.energy();
  const int steps = static_cast<int>(std::round(2 * pi / (swing * dt)));
  for (int n = 0; n < periods * steps; ++n) {
    const auto at = [&](int step) { return deformed(mesh, 0.12 * std::sin(2 * pi * step / steps)); };
    REQUIRE_ON_ALL_RANKS(solver.advance(dt, {.begin = at(n), .end = at(n + 1), .convection = {}}).converged);
  }
  return solver.energy() / before;
}

}  // namespace

TEST_CASE("a mesh that swings pumps sound too fast for the step, unless the spectral radius is below 1") {
  // A mode of ω dt >> 2 changes its sign each step, and its amplitude swings with 4 / (dt² ω): it grows where the mesh
  // swings twice as fast. 60 is ω of waves of three cells, docs/theory.md, "Time of sound".
  const double dt = 2, envelope = 4 / (dt * dt * 60);
  const double kept = growth(1, dt, 2 * envelope, 20), damped = growth(0.8, dt, 2 * envelope, 20);
  if (base::rank(MPI_COMM_WORLD) == 0) {
    fmt::print("  energy after 20 swings: {:.2g} of that at first; spectral radius 0.8: {:.2g}\n", kept, damped);
  }
  CHECK(kept > 1e3);
  CHECK(damped < 0.01);
}

}  // namespace vocalis::acoustic::test
