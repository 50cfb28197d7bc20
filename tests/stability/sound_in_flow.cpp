#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

using std::numbers::pi;

constexpr double kMach = 0.1;

struct Flow {
  const char* name;
  std::function<std::array<double, 2>(double x, double y)> velocity;
  std::vector<AcousticBoundary> boundaries;
};

/// Free of divergence. Those through the box have shear, and both ends of each kind.
std::vector<Flow> flows() {
  const auto vortex = [](double x, double y) -> std::array<double, 2> {
    return {kMach * std::sin(pi * x) * std::cos(pi * y), -kMach * std::cos(pi * x) * std::sin(pi * y)};
  };
  const auto parabola = [](double, double y) -> std::array<double, 2> { return {4 * kMach * y * (1 - y), 0}; };
  const auto layer = [](double, double y) -> std::array<double, 2> { return {kMach * std::tanh((y - 0.5) / 0.05), 0}; };
  const auto ends = [](AcousticBoundaryKind left, AcousticBoundaryKind right) -> std::vector<AcousticBoundary> {
    return {{"left", left}, {"right", right}};
  };
  constexpr auto rigid = AcousticBoundaryKind::rigid, released = AcousticBoundaryKind::pressure_release;
  constexpr auto open = AcousticBoundaryKind::open;
  return {{"vortex in a closed box", vortex, {}},
          {"parabola, rigid ends", parabola, ends(rigid, rigid)},
          {"parabola, released ends", parabola, ends(released, released)},
          {"parabola, released inlet, open outlet", parabola, ends(released, open)},
          {"shear layer, rigid ends", layer, ends(rigid, rigid)},
          {"shear layer, released ends", layer, ends(released, released)},
          {"shear layer, open ends", layer, ends(open, open)}};
}

/// Vertices of the inside pushed about, so that no cell is like another.
mesh::Mesh shaken_box(int cells) {
  mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {cells, cells, 0}));
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double* x = mesh.coordinates.data() + 2 * static_cast<std::size_t>(v);
    if (std::min({x[0], 1 - x[0], x[1], 1 - x[1]}) < 1e-9) continue;
    const double number = static_cast<double>(mesh.vertex_input[v]);
    x[0] += 0.2 / cells * std::sin(12.9898 * number * number);
    x[1] += 0.2 / cells * std::sin(78.233 * number * number);
  }
  return mesh;
}

/// The largest energy of noise over that of its start, in each half of `periods` periods of the box.
std::array<double, 2> growth(const Flow& flow, Integrator integrator, double courant_number, int periods) {
  constexpr int kCells = 12;
  const mesh::Mesh mesh = shaken_box(kCells);
  AcousticSettings settings;
  settings.speed_of_sound = 1;
  settings.density = 1;
  settings.step = courant_number / kCells;
  settings.integrator = integrator;
  settings.boundaries = flow.boundaries;
  State state;
  std::vector<double> velocity;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    const double number = static_cast<double>(mesh.vertex_input[v]);
    state.p.push_back(std::sin(12.9898 * number * number));
    state.psi.push_back(0);
    for (const double component : flow.velocity(x[0], x[1])) velocity.push_back(component);
  }
  AcousticSolver solver(mesh, settings);
  solver.set_state(state);
  const double before = solver.energy();
  Motion motion;
  motion.convection = velocity;
  std::array<double, 2> largest = {0, 0};
  for (int n = 0; n < periods; ++n) {
    if (!solver.advance(2, motion).converged) return {INFINITY, INFINITY};
    double& here = largest[2 * n >= periods];
    here = std::max(here, solver.energy() / before);
  }
  return largest;
}

void check(const Flow& flow, Integrator integrator, double courant_number, int periods, double bound) {
  const auto [early, late] = growth(flow, integrator, courant_number, periods);
  INFO(flow.name << (integrator == Integrator::implicit ? ", implicit, " : ", explicit, ") << courant_number << ": "
                 << early << " then " << late);
  CHECK(early < bound);
  CHECK(late < std::max(1.1 * early, 1.0));
}

}  // namespace

TEST_CASE("sound in a flow with shear never has more energy than the flow lets it, however its ends are") {
  // (1 - M) E < H < (1 + M) E, and H stays or falls: docs/theory.md, "Sound in a flow".
  const double bound = (1 + kMach) / (1 - kMach);
  for (const Flow& flow : flows()) {
    for (const double courant_number : {1.0, 5.0}) check(flow, Integrator::implicit, courant_number, 50, bound);
    // The leap-frog keeps an energy of its own, from which E differs by a part of itself at the mesh's frequencies.
    check(flow, Integrator::leap_frog, 5, 30, 2);
  }
}

}  // namespace vocalis::acoustic
