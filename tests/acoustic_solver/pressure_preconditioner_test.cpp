#include "acoustic_solver/pressure_preconditioner.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

/// A horn whose cells grow from 0.1 to 1 along it.
mesh::Mesh horn(int dimension) {
  const int across = dimension == 3 ? 6 : 12, layers = dimension == 3 ? 40 : 120;
  mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1.0 * layers, 1.0 * across, dimension == 3 ? 1.0 * across : 0.0},
                                    {layers, across, across});
  const double growth = std::log(10.0) / layers;
  for (std::size_t v = 0; v < whole.coordinates.size(); v += dimension) {
    double* x = whole.coordinates.data() + v;
    const double h = 0.1 * std::exp(growth * x[0]);
    x[0] = (h - 0.1) / growth;
    for (int k = 1; k < dimension; ++k) x[k] *= h;
  }
  return mesh::distribute(MPI_COMM_WORLD, whole);
}

AcousticSettings settings_of(double courant_number) {
  AcousticSettings settings;
  settings.speed_of_sound = settings.density = 1;
  settings.step = courant_number;  // of the largest cells
  settings.boundaries = {{"left", AcousticBoundaryKind::flux}, {"right", AcousticBoundaryKind::open}};
  return settings;
}

Source bell(double step) {
  return {nullptr, nullptr, [=](double t) { return std::exp(-std::pow(t / step / 10 - 2, 2)); }};
}

}  // namespace

TEST_CASE("a sub-step takes less than twelve iterations, on any number of ranks, short or long") {
  for (const int dimension : {2, 3}) {
    const mesh::Mesh mesh = horn(dimension);
    for (const double courant_number : {0.1, 0.45, 0.8, 3.0}) {
      AcousticSolver solver(mesh, settings_of(courant_number));
      const AdvanceReport report = solver.advance(40 * courant_number, {}, bell(courant_number));
      CHECK(report.converged);
      INFO(dimension << "-D, c dt / h " << courant_number);
      CHECK(report.linear_iterations < 12 * report.sub_steps);
    }
  }
}

TEST_CASE("with multigrid, too, what follows depends on the state alone") {
  const mesh::Mesh mesh = horn(3);
  AcousticSolver first(mesh, settings_of(3)), second(mesh, settings_of(3));
  first.advance(15, {}, bell(3));
  second.set_state(first.state());
  first.drop_caches();
  first.advance(15, {}, bell(3));
  second.advance(15, {}, bell(3));
  CHECK(first.state().p == second.state().p);
}

TEST_CASE("sounds that share a mesh in motion are solved for by factors, one alone by iterations") {
  const mesh::Mesh mesh = horn(2);
  AcousticSolver first(mesh, settings_of(3));
  const auto wider = [&](double factor) {
    std::vector<double> moved = mesh.coordinates;
    for (std::size_t v = 1; v < moved.size(); v += 2) moved[v] *= factor;
    return moved;
  };
  const auto iterations_beyond_passes = [&] {
    int count = 0;
    for (const double factor : {1.0, 1.1, 1.2}) {
      const std::vector<double> begin = wider(factor), end = wider(factor + 0.1);
      const AdvanceReport report = first.advance(3, {.begin = begin, .end = end, .convection = {}}, bell(3));
      CHECK(report.converged);
      count += report.linear_iterations - report.passes;
    }
    return count;
  };
  CHECK(iterations_beyond_passes() > 0);
  const AcousticSolver second = AcousticSolver::beside(first, settings_of(3));
  CHECK(iterations_beyond_passes() == 0);
}

TEST_CASE("blocks of ranks serve as long as a step crosses few cells") {
  CHECK(choose_preconditioner(2, 1, 30, 1000) == Preconditioner::cholesky);
  CHECK(choose_preconditioner(2, 4, 1, 1000) == Preconditioner::cholesky);
  CHECK(choose_preconditioner(2, 4, 30, 1000) == Preconditioner::cholesky_of_whole);
  CHECK(choose_preconditioner(2, 4, 30, 1000000) == Preconditioner::multigrid);
  CHECK(choose_preconditioner(3, 1, 1, 1000) == Preconditioner::incomplete);
  CHECK(choose_preconditioner(3, 1, 30, 1000) == Preconditioner::multigrid);
}

}  // namespace vocalis::acoustic
