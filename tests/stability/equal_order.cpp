#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic {
namespace {

constexpr int cells = 32;

AcousticSettings cavity(VelocityElements elements, double subscale_constant) {
  AcousticSettings settings;
  settings.speed_of_sound = settings.density = 1;
  settings.step = 0.5 / cells;
  settings.velocity_elements = elements;
  settings.subscale_constant = subscale_constant;
  return settings;
}

struct Fate {
  double kept = 0;      ///< of the beginning's pressure, in the beginning's shape
  double smallest = 1;  ///< of that, ever: below 0 where the mode swings
  double energy = 0;    ///< over the beginning's
};

/// A pressure that fades out towards the walls of the unit square, after some crossings of a cell by sound.
Fate fate_of(const AcousticSettings& settings, int crossings, double (*shape)(int column, int row)) {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {cells, cells, 0}));
  AcousticSolver solver(mesh, settings);
  State state;
  state.psi.assign(mesh.num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    const double envelope = std::sin(std::numbers::pi * x[0]) * std::sin(std::numbers::pi * x[1]);
    state.p.push_back(std::pow(envelope, 2) *
                      shape(static_cast<int>(std::lround(cells * x[0])), static_cast<int>(std::lround(cells * x[1]))));
  }
  const std::vector<double> begin = state.p;
  solver.set_state(state);
  const auto product = [&](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) sum += a[v] * b[v];
    return base::sum(mesh.comm, sum);
  };
  const double square = product(begin, begin), energy = solver.energy();
  Fate fate;
  const AdvanceReport report = solver.advance(static_cast<double>(crossings) / cells, {}, {}, [&](double) {
    fate.kept = product(solver.state().p, begin) / square;
    fate.smallest = std::min(fate.smallest, fate.kept);
  });
  CHECK(report.converged);
  fate.energy = solver.energy() / energy;
  return fate;
}

double sawtooth(int column, int row) { return (column + row) % 2 == 0 ? 1 : -1; }
double sawtooth_along_x(int column, int) { return column % 2 == 0 ? 1 : -1; }

}  // namespace

TEST_CASE(
    "a sawtooth keeps its shape at first and its energy in plain P1/P1, dies with subscales, and swings in P1/P0") {
  for (const auto shape : {sawtooth, sawtooth_along_x}) {
    CHECK(fate_of(cavity(VelocityElements::p1, 0), 2, shape).smallest > 0.7);
    CHECK(fate_of(cavity(VelocityElements::p0, 0), 2, shape).smallest < -0.7);
    CHECK(fate_of(cavity(VelocityElements::p1, 0), 40, shape).energy > 0.999);
    CHECK(fate_of(cavity(VelocityElements::p1, 0.02), 40, shape).energy < 1e-3);
  }
}

TEST_CASE("subscales take next to nothing from a wave that the mesh resolves") {
  const mesh::Mesh mesh = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {cells, cells, 0}));
  AcousticSolver solver(mesh, cavity(VelocityElements::p1, 0.02));
  State state;
  state.psi.assign(mesh.num_vertices(), 0.0);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    state.p.push_back(std::cos(2 * std::numbers::pi * mesh.point(v)[0]));
  }
  solver.set_state(state);
  const double before = solver.energy();
  CHECK(solver.advance(4).converged);  // wavelengths
  CHECK(1 - solver.energy() / before == Approx(6e-4).epsilon(0.3));
}

}  // namespace vocalis::acoustic
