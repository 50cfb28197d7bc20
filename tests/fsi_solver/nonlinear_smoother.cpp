#include "fsi_solver/mesh_motion/nonlinear_smoother.hpp"

#include <cmath>
#include <random>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "fsi_solver/mesh_motion/distortion_energy.hpp"
#include "fsi_solver/mesh_motion/mesh_motion.hpp"
#include "tests/all_ranks.hpp"
#include "tests/fsi_solver/room.hpp"

namespace vocalis::fsi {

namespace {

using test::largest_difference;
using test::Room;

/// The mesh when the block has gone through some positions (angle, shift), one after the other.
fem::Field after_path(const Room& room, const std::vector<std::array<double, 2>>& path) {
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field last = room.at_rest();
  for (const auto& [angle, shift] : path) {
    fem::Field next = room.moved(angle, shift);
    const SmootherReport report = smoother.extend(next, last);
    INFO("angle " << angle << " shift " << shift << " " << report.reason);
    CHECK(report.converged);
    last = next;
  }
  return last;
}

/// A cell with random corners, and displacements that do not invert it.
template <int D>
struct RandomCell {
  static constexpr int n = DistortionEnergy<D>::n;
  typename DistortionEnergy<D>::Vertices gradients, displacement;
  std::mt19937 numbers;

  explicit RandomCell(int seed) : numbers(seed) {
    std::uniform_real_distribution<double> any(-0.3, 0.3);
    typename DistortionEnergy<D>::Vertices corners{};
    std::array<const double*, D + 1> pointers;
    for (int a = 0; a <= D; ++a) {
      for (int k = 0; k < D; ++k) {
        corners[a][k] = (a == k + 1) + 0.5 * any(numbers);
        displacement[a][k] = any(numbers);
      }
      pointers[a] = corners[a].data();
    }
    gradients = fem::simplex_geometry<D>(pointers).gradient;
  }
  DistortionEnergy<D> energy() const { return {1.7, gradients, displacement}; }
  DistortionEnergy<D> energy_when(int r, double change) const {
    RandomCell other = *this;
    other.displacement[r / D][r % D] += change;
    return other.energy();
  }
};

template <int D>
void check_derivatives() {
  constexpr double h = 1e-5;
  for (int seed = 0; seed < 20; ++seed) {
    RandomCell<D> cell(seed);
    const DistortionEnergy<D> energy = cell.energy();
    INFO("seed " << seed << " J " << energy.j());
    REQUIRE(energy.j() > 0);
    constexpr int n = RandomCell<D>::n;
    const auto gradient = energy.gradient();
    std::array<double, n * n> hessian, convex;
    energy.hessian(2, true, hessian.data());
    energy.hessian(1, false, convex.data());
    for (int r = 0; r < n; ++r) {
      const DistortionEnergy<D> up = cell.energy_when(r, h), down = cell.energy_when(r, -h);
      CHECK(gradient[r] == Approx((up.value() - down.value()) / (2 * h)).epsilon(1e-6).margin(1e-6));
      const auto rises = up.gradient(), falls = down.gradient();
      for (int s = 0; s < n; ++s) {
        CHECK(hessian[r * n + s] == Approx((rises[s] - falls[s]) / h).epsilon(1e-5).margin(1e-5));
      }
    }
    std::normal_distribution<double> any;
    for (int trial = 0; trial < 50; ++trial) {
      std::array<double, n> direction;
      for (double& value : direction) value = any(cell.numbers);
      double curvature = 0;
      for (int r = 0; r < n; ++r) {
        for (int s = 0; s < n; ++s) curvature += direction[r] * convex[r * n + s] * direction[s];
      }
      CHECK(curvature > -1e-10);
    }
  }
}

template <int D>
void check_linear_elasticity() {
  RandomCell<D> cell(3);
  cell.displacement = {};
  constexpr int n = RandomCell<D>::n;
  std::array<double, n * n> hessian;
  cell.energy().hessian(1, true, hessian.data());
  const auto& g = cell.gradients;
  for (int r = 0; r < n; ++r) {
    CHECK(std::abs(cell.energy().gradient()[r]) < 1e-14);
    for (int s = 0; s < n; ++s) {
      const int a = r / D, i = r % D, b = s / D, k = s % D;
      double expected = (1.7 - 2.0 / D) * g[a][i] * g[b][k] + g[b][i] * g[a][k];
      for (int m = 0; m < D; ++m) expected += (i == k) * g[a][m] * g[b][m];
      CHECK(hessian[r * n + s] == Approx(expected).margin(1e-12));
    }
  }
}

}  // namespace

TEST_CASE(
    "gradient and Hessian are the derivatives of the distortion energy, its convex part has no negative curvature",
    "[serial]") {
  check_derivatives<2>();
  check_derivatives<3>();
}

TEST_CASE("the distortion energy at rest is linear elasticity", "[serial]") {
  check_linear_elasticity<2>();
  check_linear_elasticity<3>();
}

TEST_CASE("a cell that a step would invert has infinite energy") {
  const Room room(2, 6);
  const MeshEnergy energy(room.continuum, 1);
  const MeshEnergy::Change change = energy.change(room.at_rest(), room.moved(0, 0.8));
  CHECK(change.volume < 0);
  CHECK(std::isinf(change.energy));
  CHECK(energy.smallest_volume(room.moved(0, 0.8)) == Approx(change.volume));
}

TEST_CASE("the gradient of the mesh's energy is how it changes") {
  for (const int dimension : {2, 3}) {
    const Room room(dimension, 3 * (5 - dimension));
    const MeshEnergy energy(room.continuum, 0.7);
    const fem::Field middle = room.moved(5, 0.02);
    fem::Field up = middle, down = middle;
    fem::Field direction = room.at_rest();
    for (std::size_t i = 0; i < direction.values.size(); ++i) {
      const double x = room.mesh.coordinates[i];
      direction.values[i] = 1e-5 * std::sin(7 * x + static_cast<double>(i % dimension));
      up.values[i] += direction.values[i];
      down.values[i] -= direction.values[i];
    }
    const fem::Load gradient = energy.gradient(middle);
    double slope = 0;
    const std::size_t owned = static_cast<std::size_t>(room.mesh.vertices.num_owned) * dimension;
    for (std::size_t i = 0; i < owned; ++i) slope += gradient.values[i] * direction.values[i];
    CHECK(energy.change(down, up).energy == Approx(2 * base::sum(MPI_COMM_WORLD, slope)).epsilon(1e-5));
  }
}

TEST_CASE("a mesh whose solids do not move stays where it is") {
  const Room room(2, 12);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field displacement = room.at_rest();
  const SmootherReport report = smoother.extend(displacement, room.at_rest());
  CHECK(report.converged);
  CHECK(report.iterations == 1);
  CHECK(largest_difference(displacement, room.at_rest()) < 1e-14);
  CHECK(report.smallest_quality == Approx(room.quality(room.at_rest())));
}

TEST_CASE("small displacements move the mesh as linear elasticity does") {
  const Room room(2, 12);
  MeshMotion linear(room.continuum, room.conditions, 1);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field one = room.moved(1e-4, 1e-6), other = one;
  linear.extend(one);
  CHECK(smoother.extend(other, room.at_rest()).converged);
  CHECK(largest_difference(one, other) < 1e-9);
}

TEST_CASE("a block that turns far or comes near a wall inverts the cells of linear elasticity, not these") {
  const Room room(2, 24);
  MeshMotion linear(room.continuum, room.conditions, 1);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  struct Position {
    double angle, shift, quality;
  };
  for (const auto& [angle, shift, quality] : {Position{60, 0, 0.18}, {100, 0, 0.08}, {0, 0.8, 0.13}, {30, 0.6, 0.13}}) {
    fem::Field one = room.moved(angle, shift), other = one;
    linear.extend(one);
    const SmootherReport report = smoother.extend(other, room.at_rest());
    INFO("angle " << angle << " shift " << shift << ": " << report.iterations << " iterations " << report.reason);
    CHECK(report.converged);
    CHECK(room.quality(one) < -0.1);
    CHECK(report.smallest_quality > quality);
    CHECK(report.smallest_quality == Approx(room.quality(other)));
  }
}

TEST_CASE("tetrahedra around a block that turns stay whole") {
  const Room room(3, 6);
  MeshMotion linear(room.continuum, room.conditions, 1);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field one = room.moved(60, 0), other = one;
  linear.extend(one);
  const SmootherReport report = smoother.extend(other, room.at_rest());
  INFO(report.iterations << " iterations " << report.reason);
  CHECK(report.converged);
  CHECK(room.quality(one) < 0);
  CHECK(report.smallest_quality > 0.1);
}

TEST_CASE("the mesh depends on where the solids are, not on how they came there") {
  const Room room(2, 24);
  const fem::Field direct = after_path(room, {{40, 0.4}});
  CHECK(largest_difference(direct, after_path(room, {{40, 0}, {40, 0.4}})) < 1e-8);
  CHECK(largest_difference(direct, after_path(room, {{0, 0.4}, {20, 0.4}, {40, 0.4}})) < 1e-8);
  CHECK(largest_difference(direct, after_path(room, {{-30, -0.3}, {0, 0.5}, {40, 0.4}})) < 1e-8);
  CHECK(largest_difference(room.at_rest(), after_path(room, {{40, 0.4}, {70, 0.1}, {0, 0}})) < 1e-8);
}

TEST_CASE("small steps take few iterations") {
  const Room room(2, 24);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field last = room.moved(40, 0.2);
  REQUIRE_ON_ALL_RANKS(smoother.extend(last, room.at_rest()).converged);
  for (const double angle : {40.1, 40.2, 40.3}) {
    fem::Field next = room.moved(angle, 0.2);
    const SmootherReport report = smoother.extend(next, last);
    CHECK(report.converged);
    CHECK(report.iterations <= 6);
    CHECK(report.factorisations <= 1);
    last = next;
  }
}

TEST_CASE("without the factors of earlier searches the mesh is the same to the last bit") {
  const Room room(2, 12);
  NonlinearSmoother one(room.continuum, room.conditions, 1), other(room.continuum, room.conditions, 1);
  fem::Field elsewhere = room.moved(20, 0.1), here = room.moved(22, 0.12), there = here;
  CHECK(one.extend(elsewhere, room.at_rest()).converged);
  one.drop_factors();
  CHECK(one.extend(here, elsewhere).converged);
  CHECK(other.extend(there, elsewhere).converged);
  CHECK(here.values == there.values);
}

TEST_CASE("a start with inverted cells is as good as none") {
  const Room room(2, 12);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field one = room.moved(30, 0.3), other = one;
  CHECK(smoother.extend(one, room.at_rest()).converged);
  CHECK(smoother.extend(other, room.moved(0, -0.9)).converged);
  CHECK(largest_difference(one, other) < 1e-8);
}

TEST_CASE("a mesh that buckles leaves the saddle where it stood") {
  const Room room(2, 12, true);
  for (const double shift : {-0.4, 0.0, 0.4}) {
    NonlinearSmoother smoother(room.continuum, room.conditions, 1);
    fem::Field last = room.at_rest();
    for (double angle = 4; angle <= 180; angle += 4) {
      fem::Field next = room.moved(angle, shift);
      const SmootherReport report = smoother.extend(next, last);
      INFO("angle " << angle << " shift " << shift << ": " << report.iterations << " iterations " << report.reason);
      CHECK(report.converged);
      CHECK(report.iterations <= 40);
      CHECK(report.smallest_quality > 0.02);
      last = next;
    }
  }
}

TEST_CASE("solids that leave no room for the mesh end the search with a reason") {
  const Room room(2, 6);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field displacement = room.moved(0, 1.2);
  const SmootherReport report = smoother.extend(displacement, room.at_rest());
  CHECK_FALSE(report.converged);
  CHECK_FALSE(report.reason.empty());
  CHECK(report.smallest_quality < 0);
  fem::Field possible = room.moved(0, 0.3);
  CHECK(smoother.extend(possible, displacement).converged);
}

TEST_CASE("the mesh slides along a symmetry and stays on it") {
  const Room room(2, 12, true);
  NonlinearSmoother smoother(room.continuum, room.conditions, 1);
  fem::Field displacement = room.moved(30, 0.5);
  CHECK(smoother.extend(displacement, room.at_rest()).converged);
  double along = 0;
  for (std::int32_t v = 0; v < room.mesh.num_vertices(); ++v) {
    if (room.mesh.point(v)[1] < 3 - 1e-9) continue;
    CHECK(displacement.at(v)[1] == 0);
    along = std::max(along, std::abs(displacement.at(v)[0]));
  }
  CHECK(base::largest(MPI_COMM_WORLD, along) > 0.02);
}

TEST_CASE("the mesh is the same on any number of ranks") {
  const Room room(2, 12), alone(2, 12, false, MPI_COMM_SELF);
  NonlinearSmoother together(room.continuum, room.conditions, 1), single(alone.continuum, alone.conditions, 1);
  fem::Field here = room.moved(60, 0.2), there = alone.moved(60, 0.2);
  CHECK(together.extend(here, room.at_rest()).converged);
  CHECK(single.extend(there, alone.at_rest()).converged);
  std::vector<std::int32_t> vertex_of(alone.mesh.num_vertices());
  for (std::int32_t v = 0; v < alone.mesh.num_vertices(); ++v) vertex_of[alone.mesh.vertex_input[v]] = v;
  double difference = 0;
  for (std::int32_t v = 0; v < room.mesh.num_vertices(); ++v) {
    for (int k = 0; k < 2; ++k) {
      const double other = there.at(vertex_of[room.mesh.vertex_input[v]])[k];
      difference = std::max(difference, std::abs(here.at(v)[k] - other));
    }
  }
  CHECK(difference < 1e-8);
}

}  // namespace vocalis::fsi
