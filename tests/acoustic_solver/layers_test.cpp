#include <algorithm>
#include <cmath>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/acoustic_solver/cavity.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

/// A strip of cells of 0.05.
mesh::Mesh strip(int dimension, int cells, MPI_Comm comm = MPI_COMM_WORLD) {
  const double length = 0.05 * cells;
  return mesh::distribute(comm, mesh::box(comm, {length, 0.2, dimension == 3 ? 0.2 : 0.0}, {cells, 4, 4}));
}

AcousticSettings unit_medium() {
  AcousticSettings settings = test::unit_medium(0.025);
  settings.solver_tolerance = 1e-10;
  return settings;
}

AbsorbingLayer layer(LayerKind kind, std::vector<BoxSide> sides, double thickness = 0.5) {
  AbsorbingLayer result;
  result.kind = kind;
  result.sides = std::move(sides);
  result.thickness = thickness;
  return result;
}

double bell(double t) { return std::exp(-std::pow((t - 1) / 0.25, 2)); }

/// Pressure at the left end over time, where a pulse enters and an echo would come back.
std::vector<double> record(AcousticSolver& solver, const mesh::Mesh& mesh, double duration) {
  std::vector<double> heard;
  const auto listen = [&](double) {
    double sum = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      if (mesh.point(v)[0] == 0) sum += solver.state().p[v];
    }
    heard.push_back(base::sum(mesh.comm, sum));
  };
  REQUIRE_ON_ALL_RANKS(
      solver.advance(duration, {}, {.begin = nullptr, .end = nullptr, .flux = bell}, listen).converged);
  return heard;
}

/// What the end of the strip reflects: the record against that of a strip too long for echoes, over the largest
/// pressure; half of it, since an echo meets a rigid wall where it is heard.
double reflection(int dimension, AcousticSettings settings) {
  settings.boundaries = {{"left", AcousticBoundaryKind::flux}};
  const mesh::Mesh short_one = strip(dimension, 30), long_one = strip(dimension, 90);
  AcousticSolver solver(short_one, settings);
  settings.layers.clear();
  AcousticSolver reference(long_one, settings);
  const auto heard = record(solver, short_one, 7), expected = record(reference, long_one, 7);
  double difference = 0, largest = 0;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    difference = std::max(difference, std::abs(heard[i] - expected[i]));
    largest = std::max(largest, std::abs(expected[i]));
  }
  return 0.5 * difference / largest;
}

void throws(const AcousticSettings& settings, const std::string& words) {
  const mesh::Mesh mesh = strip(2, 30);
  std::string said;
  try {
    const AcousticSolver solver(mesh, settings);
  } catch (const base::UserError& error) {
    said = error.what();
  }
  CHECK_THAT(said, Catch::Contains(words));
}

}  // namespace

TEST_CASE("a layer takes a plane pulse, whatever its kind, spectral radius and dimension") {
  // Ten cells. Without the corrections for finite cells 0.0017 would be reflected (docs/theory.md).
  for (const int dimension : {2, 3}) {
    for (const LayerKind kind : {LayerKind::pml, LayerKind::sponge}) {
      AcousticSettings settings = unit_medium();
      settings.layers = {layer(kind, {BoxSide::x_max})};
      CHECK(reflection(dimension, settings) < 8e-4);
      if (dimension == 3) continue;
      settings.spectral_radius = 0.5;
      CHECK(reflection(dimension, settings) < 8e-4);
    }
  }
  CHECK(reflection(2, unit_medium()) > 0.5);
}

TEST_CASE("layers with edges and corners do not depend on the number of ranks") {
  for (const int dimension : {2, 3}) {
    AcousticSettings settings = unit_medium();
    settings.boundaries = {{"left", AcousticBoundaryKind::flux}};
    settings.layers = {layer(LayerKind::pml, {BoxSide::x_max}), layer(LayerKind::pml, {BoxSide::y_max}, 0.11)};
    if (dimension == 3) settings.layers.push_back(layer(LayerKind::pml, {BoxSide::z_min}, 0.11));
    const auto run = [&](MPI_Comm comm) {
      const mesh::Mesh mesh = strip(dimension, 30, comm);
      AcousticSolver solver(mesh, settings);
      return record(solver, mesh, 3);
    };
    const auto alone = run(MPI_COMM_SELF), together = run(MPI_COMM_WORLD);
    REQUIRE_ON_ALL_RANKS(alone.size() == together.size());
    double difference = 0, largest = 0;
    for (std::size_t i = 0; i < alone.size(); ++i) {
      difference = std::max(difference, std::abs(alone[i] - together[i]));
      largest = std::max(largest, std::abs(alone[i]));
    }
    CHECK(largest > 0.1);
    CHECK(difference < 1e-8 * largest);
  }
}

TEST_CASE("a state with its layers goes on exactly, and one without them does not") {
  AcousticSettings settings = unit_medium();
  settings.boundaries = {{"left", AcousticBoundaryKind::flux}};
  settings.layers = {layer(LayerKind::pml, {BoxSide::x_max}),
                     layer(LayerKind::pml, {BoxSide::y_max, BoxSide::z_min}, 0.11)};
  const mesh::Mesh mesh = strip(3, 30);
  AcousticSolver solver(mesh, settings);
  record(solver, mesh, 2.5);
  const auto end_of = [&](State state) {
    AcousticSolver other(mesh, settings);
    other.set_state(std::move(state));
    record(other, mesh, 0.5);
    return other.state().p;
  };
  const State state = solver.state();
  State without_flux = state, without_integral = state;
  without_flux.layer_flux.clear();
  without_integral.layer_integral.clear();
  record(solver, mesh, 0.5);
  const auto difference = [&](const std::vector<double>& p) {
    double largest = 0;
    for (std::size_t v = 0; v < p.size(); ++v) largest = std::max(largest, std::abs(p[v] - solver.state().p[v]));
    return base::largest(mesh.comm, largest);
  };
  CHECK(difference(end_of(state)) < 1e-8);
  CHECK(difference(end_of(without_flux)) > 0.1);
  CHECK(difference(end_of(without_integral)) > 1e-3);
}

TEST_CASE("layers that make no sense are the user's mistake") {
  AcousticSettings settings = unit_medium();
  const auto with = [&](std::vector<AbsorbingLayer> layers) {
    settings.layers = std::move(layers);
    return settings;
  };
  throws(with({layer(LayerKind::pml, {BoxSide::x_max}, 0)}), "positive");
  throws(with({layer(LayerKind::pml, {BoxSide::x_max}, 0.08)}), "two cells");
  throws(with({layer(LayerKind::pml, {BoxSide::x_max}, 1.5)}), "room for sound");
  throws(with({layer(LayerKind::pml, {BoxSide::x_min, BoxSide::x_max}, 0.8)}), "do not overlap");
  throws(with({layer(LayerKind::pml, {BoxSide::x_max, BoxSide::x_max})}), "do not overlap");
  throws(with({layer(LayerKind::pml, {BoxSide::z_max})}), "x_min, x_max, y_min and y_max");
  throws(with({layer(LayerKind::pml, {BoxSide::x_max}), layer(LayerKind::sponge, {BoxSide::x_min})}), "one kind");
  AbsorbingLayer mirror = layer(LayerKind::pml, {BoxSide::x_max});
  mirror.reflection = 1;
  throws(with({mirror}), "between 0 and 1");
  AcousticSettings leaping = with({layer(LayerKind::pml, {BoxSide::x_max})});
  leaping.integrator = Integrator::leap_frog;
  throws(leaping, "need the implicit integrator");

  const mesh::Mesh mesh = strip(2, 30);
  AcousticSolver solver(mesh, with({layer(LayerKind::pml, {BoxSide::x_max})}));
  std::vector<double> moved = mesh.coordinates;
  for (std::size_t i = 0; i < moved.size(); i += 2) moved[i] *= 1.01;
  CHECK_THROWS_AS(solver.advance(0.1, {mesh.coordinates, moved}), base::UserError);
  for (std::size_t i = 0; i < moved.size(); i += 2) {
    const double x = mesh.coordinates[i];
    moved[i] = x < 0.95 ? x + 0.01 * x * (0.95 - x) : x;
  }
  CHECK(solver.advance(0.1, {mesh.coordinates, moved}).converged);
}

}  // namespace vocalis::acoustic
