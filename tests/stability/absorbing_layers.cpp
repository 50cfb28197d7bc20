#include <algorithm>
#include <cmath>

#include "acoustic_solver/acoustic_solver.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

constexpr double cell = 1;  ///< all lengths in cells, speed of sound and density 1

AcousticSettings unit_medium(double step) {
  AcousticSettings settings;
  settings.speed_of_sound = 1;
  settings.density = 1;
  settings.step = step;
  return settings;
}

AbsorbingLayer layer(std::vector<BoxSide> sides, int cells, double reflection) {
  AbsorbingLayer result;
  result.sides = std::move(sides);
  result.thickness = cells * cell;
  result.reflection = reflection;
  return result;
}

mesh::Mesh box(std::array<int, 3> cells) {
  return mesh::distribute(MPI_COMM_WORLD,
                          mesh::box(MPI_COMM_WORLD, {1.0 * cells[0], 1.0 * cells[1], 1.0 * cells[2]}, cells));
}

double largest(MPI_Comm comm, const std::vector<double>& values) {
  double result = 0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return base::largest(comm, result);
}

/// A pulse enters through the lower part of the left end of a long channel, whose floor is rigid and whose upper side
/// is open behind `depth` cells: what is heard on the floor far away, and what is left `later`.
struct Channel {
  std::vector<double> heard;
  double early = 0, late = 0;  ///< largest pressure at the end of the record, and later
};

Channel channel(int height, const std::vector<AbsorbingLayer>& layers, double later = 0) {
  constexpr int length = 80;
  const mesh::Mesh mesh = box({length, height, 0});
  AcousticSettings settings = unit_medium(0.7);
  settings.layers = layers;
  if (layers.empty()) settings.boundaries = {{"top", AcousticBoundaryKind::open}};
  AcousticSolver solver(mesh, settings);
  State state = solver.state();
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const double* x = mesh.point(v);
    state.p[v] = std::exp(-(x[0] * x[0] + x[1] * x[1]) / 9);
  }
  solver.set_state(state);
  Channel result;
  const auto listen = [&](double) {
    double sum = 0;
    for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
      if (mesh.point(v)[0] == 60 && mesh.point(v)[1] == 0) sum = solver.state().p[v];
    }
    result.heard.push_back(base::sum(mesh.comm, sum));
  };
  REQUIRE_ON_ALL_RANKS(solver.advance(84, {}, {}, listen).converged);
  result.early = largest(mesh.comm, solver.state().p);
  if (later > 0) REQUIRE_ON_ALL_RANKS(solver.advance(later).converged);
  result.late = largest(mesh.comm, solver.state().p);
  return result;
}

double error(const Channel& channel, const Channel& reference) {
  double difference = 0, scale = 0;
  for (std::size_t i = 0; i < reference.heard.size(); ++i) {
    difference = std::max(difference, std::abs(channel.heard[i] - reference.heard[i]));
    scale = std::max(scale, std::abs(reference.heard[i]));
  }
  return difference / scale;
}

}  // namespace

TEST_CASE("grazing sound: a weak layer reflects it, a strong one does not, and neither grows") {
  const Channel reference = channel(70, {});
  const double first_order = error(channel(8, {}), reference);
  const Channel weak = channel(8 + 4, {layer({BoxSide::y_max}, 4, 0.1)}, 2000);
  const Channel strong = channel(8 + 16, {layer({BoxSide::y_max}, 16, 1e-3)}, 2000);
  UNSCOPED_INFO("first order " << first_order << ", weak layer " << error(weak, reference) << ", strong layer "
                               << error(strong, reference) << ", late " << weak.late << " and " << strong.late);
  CHECK(first_order > 0.3);
  CHECK(error(weak, reference) > 0.1);
  CHECK(error(strong, reference) < 0.01);
  CHECK(weak.late < 0.1 * weak.early);
  CHECK(strong.late < 0.1 * strong.early);
}

TEST_CASE("layers on all sides die out: no growth at late times, however long the step", "[serial]") {
  struct Case {
    std::array<int, 3> cells;
    double step;
    int steps;
  };
  for (const Case& now : {Case{{12, 12, 0}, 0.7, 50000}, Case{{12, 12, 0}, 7, 5000}, Case{{8, 8, 8}, 0.7, 1000}}) {
    const mesh::Mesh mesh = box(now.cells);
    AcousticSettings settings = unit_medium(now.step);
    std::vector<BoxSide> sides = {BoxSide::x_min, BoxSide::x_max, BoxSide::y_min, BoxSide::y_max};
    if (now.cells[2] > 0) sides.insert(sides.end(), {BoxSide::z_min, BoxSide::z_max});
    settings.layers = {layer(sides, 3, 1e-4)};
    AcousticSolver solver(mesh, settings);
    State state = solver.state();
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      double square = 0;
      for (int k = 0; k < mesh.dimension; ++k) square += std::pow(mesh.point(v)[k] - 0.45 * now.cells[k], 2);
      state.p[v] = std::exp(-square / 2);
    }
    solver.set_state(state);
    // Fifths of the run, since modes beat: each leaves less than the one before, down to round-off.
    double before = 1;
    bool decays = true;
    for (int part = 0; part < 5; ++part) {
      REQUIRE_ON_ALL_RANKS(solver.advance(now.step * now.steps / 5).converged);
      const double left = std::max(largest(mesh.comm, solver.state().p), largest(mesh.comm, solver.state().psi));
      decays = decays && (left < before || left < 1e-12);
      before = left;
    }
    CHECK(decays);
    CHECK(before < 1e-3);
  }
}

TEST_CASE("late times: thin layers along two of three axes grow, and are refused; six cells die out", "[serial]") {
  const auto make = [](const mesh::Mesh& mesh, int cells, bool may_grow) {
    AcousticSettings settings = unit_medium(0.7);
    settings.layers = {layer({BoxSide::x_max, BoxSide::y_max}, cells, 1e-3)};
    settings.layers.front().may_grow = may_grow;
    return AcousticSolver(mesh, settings);
  };
  /// Largest pressure of a pulse in the corner opposite to the edge, when it has long gone and later.
  const auto left_of_a_pulse = [](const mesh::Mesh& mesh, AcousticSolver solver) {
    State state = solver.state();
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      const double* x = mesh.point(v);
      state.p[v] = std::exp(-(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) / 4);
    }
    solver.set_state(state);
    std::array<double, 2> left = {};
    for (double& now : left) {
      REQUIRE_ON_ALL_RANKS(solver.advance(800).converged);
      now = largest(mesh.comm, solver.state().p);
    }
    return left;
  };
  const mesh::Mesh thin = box({8, 8, 4}), thick = box({10, 10, 4});
  CHECK_THROWS_AS(make(thin, 4, false), base::UserError);
  const auto growing = left_of_a_pulse(thin, make(thin, 4, true));
  const auto dying = left_of_a_pulse(thick, make(thick, 6, false));
  UNSCOPED_INFO("four cells leave " << growing[0] << ", then " << growing[1] << "; six " << dying[0] << ", then "
                                    << dying[1]);
  CHECK(growing[1] > 1);
  CHECK(growing[1] > 10 * growing[0]);
  CHECK(dying[1] < 1e-3);
  CHECK(dying[1] < dying[0]);
}

}  // namespace vocalis::acoustic
