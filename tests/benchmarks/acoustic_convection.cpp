// Passes and processor time of an implicit sub-step in a jet, against |U| dt / h.
//
//   ninja benchmark_acoustic_convection; benchmark_acoustic_convection [-speed 40] [-cells 200]
//
// A duct of 20 x 4 mm with open ends, a jet U = speed / cosh²(y / 0.4 mm) along it, and a pulse of 1.5 mm in it; or, in
// rows "noise", something of all modes of the mesh.

#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "core/la/petsc.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

constexpr double kLength = 0.02, kHeight = 0.004, kJet = 0.0004;

std::vector<double> jet(const mesh::Mesh& mesh, double speed) {
  std::vector<double> result(mesh.coordinates.size(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    result[2 * v] = speed / std::pow(std::cosh((mesh.point(v)[1] - kHeight / 2) / kJet), 2);
  }
  return result;
}

State start(const mesh::Mesh& mesh, bool is_noise) {
  State state;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    const double number = static_cast<double>(mesh.vertex_input[v]);
    const double pulse = std::exp(-std::pow((x[0] - kLength / 2) / 1.5e-3, 2) - std::pow(x[1] / 1.5e-3, 2));
    state.p.push_back(is_noise ? std::sin(12.9898 * number * number) : pulse);
    state.psi.push_back(0);
  }
  return state;
}

void measure(const mesh::Mesh& mesh, double speed, double h, double courant_number, bool is_noise) {
  AcousticSettings settings;
  settings.step = courant_number * h / speed;
  settings.integrator = Integrator::implicit;
  settings.boundaries = {{"left", AcousticBoundaryKind::open}, {"right", AcousticBoundaryKind::open}};
  AcousticSolver solver(mesh, settings);
  solver.set_state(start(mesh, is_noise));
  const std::vector<double> flow = jet(mesh, speed);
  Motion motion;
  motion.convection = flow;
  constexpr int kSteps = 20;
  solver.advance(settings.step, motion);
  const std::clock_t begin = std::clock();
  const AdvanceReport report = solver.advance(kSteps * settings.step, motion);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  if (base::rank(mesh.comm) != 0) return;
  fmt::print("{:8.1f} {:8.1f} {:>7} {:8.1f} {:8.1f} {:11.1f} {}\n", courant_number,
             settings.speed_of_sound * settings.step / h, is_noise ? "noise" : "pulse",
             report.passes / static_cast<double>(kSteps), report.linear_iterations / static_cast<double>(kSteps),
             1e3 * seconds / kSteps, report.reason);
}

}  // namespace
}  // namespace vocalis::acoustic

int main(int argc, char** argv) {
  using namespace vocalis;
  const base::Session session(argc, argv);
  PetscReal speed = 40;
  PetscInt cells = 200;
  base::check(PetscOptionsGetReal(nullptr, nullptr, "-speed", &speed, nullptr));
  base::check(PetscOptionsGetInt(nullptr, nullptr, "-cells", &cells, nullptr));
  const auto along = static_cast<int>(cells);
  const mesh::Mesh mesh = mesh::distribute(
      MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {acoustic::kLength, acoustic::kHeight, 0}, {along, along / 5, 0}));
  if (base::rank(MPI_COMM_WORLD) == 0) {
    fmt::print("|U|dt/h  c dt/h   start   passes  iterat.   ms a step\n");
  }
  for (const double courant_number : {0.1, 1.0, 5.0, 20.0}) {
    for (const bool is_noise : {false, true}) {
      acoustic::measure(mesh, speed, acoustic::kLength / along, courant_number, is_noise);
    }
  }
  return 0;
}
