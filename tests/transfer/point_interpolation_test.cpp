#include "transfer/point_interpolation.hpp"

#include <cmath>
#include <map>
#include <numeric>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/cell_tree.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"
#include "tests/interpolate.hpp"
#include "tests/transfer/random_case.hpp"
#include "tests/transfer/world_split.hpp"
#include "transfer/strip.hpp"

using namespace vocalis;
using namespace vocalis::transfer;

namespace {

double sum_of(MPI_Comm comm, std::span<const double> values) {
  return base::sum(comm, std::accumulate(values.begin(), values.end(), 0.0));
}

double size_of(MPI_Comm comm, std::span<const double> values) {
  return base::sum(comm, std::accumulate(values.begin(), values.end(), 0.0,
                                         [](double sum, double value) { return sum + std::abs(value); }));
}

double product(MPI_Comm comm, std::span<const double> a, std::span<const double> b) {
  return base::sum(comm, std::inner_product(a.begin(), a.end(), b.begin(), 0.0));
}

/// A few points of this rank around the unit box, as many as it likes, and two numbers at each.
struct Scattered {
  std::vector<double> points, numbers;

  Scattered(Random& random, int dimension) {
    const std::int64_t count = draw(random, 3) == 0 ? 0 : draw(random, 40);
    for (std::int64_t i = 0; i < count * dimension; ++i) points.push_back(1e-3 * (draw(random, 1200) - 100.0));
    for (std::int64_t i = 0; i < count * 2; ++i) numbers.push_back(1e-3 * (draw(random, 2000) - 1000.0));
  }
};

/// A linear function and a rough one.
fem::Field two_functions(const fem::Space& space) {
  return fem::interpolate(space, 2, [](auto x, auto values) {
    values[0] = 1 + 2 * x[0] - 3 * x[1];
    values[1] = std::sin(40 * x[0]) + std::cos(50 * x[1]);
  });
}

/// Distance of a point from the nearest of all cells.
double distance_from(const mesh::WholeMesh& whole, const std::vector<std::int32_t>& mask, const double* x, int d) {
  mesh::WholeMesh kept = whole;
  kept.facet_vertices.clear();
  kept.facet_group.clear();
  kept.curved_edges.clear();
  kept.curved_points.clear();
  const mesh::Mesh all = mesh::build_mesh(
      MPI_COMM_SELF, mesh::scatter(MPI_COMM_SELF, kept, std::vector<std::int32_t>(kept.num_cells(), 0)));
  std::array<double, 3> point = {0, 0, 0};
  std::copy_n(x, d, point.begin());
  double distance = mesh::Box::infinity;
  for (std::int32_t cell = 0; cell < all.num_cells(); ++cell) {
    if (mask[cell]) distance = std::min(distance, mesh::closest_point(all, cell, point).distance);
  }
  return distance;
}

/// The integrals of a function against the basis functions, summed over each rank's own cells alone.
fem::Load load_of(const fem::Space& space, double (*function)(double, double)) {
  const mesh::Mesh& mesh = *space.mesh;
  const fem::QuadratureRule& quadrature = fem::quadrature(2, 4);
  fem::Load load(space, 1);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto v = mesh.vertices_of(cell);
    const double area = fem::simplex_geometry<2>({mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2])}).measure;
    for (std::size_t q = 0; q < quadrature.weights.size(); ++q) {
      double x = 0, y = 0;
      for (int i = 0; i < 3; ++i) {
        x += quadrature.points[q][i] * mesh.point(v[i])[0];
        y += quadrature.points[q][i] * mesh.point(v[i])[1];
      }
      for (int i = 0; i < 3; ++i) {
        load.values[v[i]] += area * quadrature.weights[q] * quadrature.points[q][i] * function(x, y);
      }
    }
  }
  return load;
}

mesh::Mesh unit_square(int cells) {
  return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {cells, cells, 0}));
}

}  // namespace

TEST_CASE("fields at points and loads of points are each other's transpose on any mesh and partition") {
  const WorldSplits splits;
  for (int trial = 0; trial < 60; ++trial) {
    const auto& split = splits.turn(trial);
    Random random(9000 + 2 * trial + split.is_upper);
    const RandomCase test = random_case(random, base::size(split.comm));
    random.discard(base::rank(split.comm));
    const mesh::Mesh mesh = test.distribute(split.comm);
    const Scattered scattered(random, mesh.dimension);
    const PointInterpolation interpolation(mesh, scattered.points);
    const fem::Space space = fem::lagrange(mesh, 1);
    const fem::Field field = two_functions(space);
    std::vector<double> read(scattered.numbers.size());
    fem::Load load(space, 2);
    interpolation.evaluate(field, read);
    interpolation.restrict_to(scattered.numbers, load);
    const double size = size_of(split.comm, scattered.numbers) + 1e-300;
    INFO("trial " << trial << " on " << base::size(split.comm) << " ranks");
    CHECK(std::abs(sum_of(split.comm, load.values) - sum_of(split.comm, scattered.numbers)) <= 1e-13 * size);
    const double there = product(split.comm, load.values, field.values);
    CHECK(std::abs(there - product(split.comm, scattered.numbers, read)) <= 1e-12 * size);
    // Ghosts count nothing, so the owners' values alone are the load.
    CHECK(std::all_of(load.values.begin() + 2 * mesh.vertices.num_owned, load.values.end(),
                      [](double value) { return value == 0; }));
    // The mesh is the unit box: linear functions are exact inside, and at the nearest point for points outside.
    const std::size_t d = mesh.dimension;
    std::int64_t outside = 0;
    for (std::size_t j = 0; j < read.size() / 2; ++j) {
      const double* x = scattered.points.data() + j * d;
      CHECK(read[2 * j] == Approx(1 + 2 * std::clamp(x[0], 0.0, 1.0) - 3 * std::clamp(x[1], 0.0, 1.0)).margin(1e-12));
      outside += std::any_of(x, x + d, [](double value) { return value < 0 || value > 1; });
    }
    CHECK(interpolation.outside().count == base::sum(split.comm, outside));
  }
}

TEST_CASE("points outside go to the nearest cell of all ranks, and are refused further away than its size") {
  const WorldSplits splits;
  int refused = 0, taken = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto& split = splits.turn(trial);
    Random random(9500 + 2 * trial + split.is_upper);
    const RandomCase test = random_case(random, base::size(split.comm));
    std::vector<std::int32_t> mask = random_mask(random, test);
    mask.back() = 1;
    random.discard(base::rank(split.comm));
    const mesh::Mesh parent = test.distribute(split.comm);
    const StrippedMesh some = strip(parent, mask_of_rank(test, mask, base::rank(split.comm)));
    const Scattered scattered(random, parent.dimension);
    double furthest = 0;
    for (std::size_t j = 0; j < scattered.points.size(); j += parent.dimension) {
      furthest = std::max(furthest, distance_from(test.whole, mask, scattered.points.data() + j, parent.dimension));
    }
    furthest = base::largest(split.comm, furthest);
    const PointInterpolation interpolation(some.mesh, scattered.points);
    const std::vector<std::int32_t> held = interpolation.is_held();
    const std::int64_t lost = base::sum(split.comm, static_cast<std::int64_t>(std::count(held.begin(), held.end(), 0)));
    try {
      interpolation.require_all("points lie in the mesh");
      CHECK(interpolation.outside().distance == Approx(furthest).margin(1e-9));
      CHECK(lost == 0);
      ++taken;
    } catch (const base::UserError&) {
      CHECK(furthest > 0.2);  // shorter than any cell of these meshes
      CHECK(lost > 0);
      ++refused;
    }
    // The same by leaving out cells of the whole.
    const auto counts = mask_of_rank(test, mask, base::rank(split.comm));
    CHECK(PointInterpolation(parent, scattered.points, counts).outside().distance == interpolation.outside().distance);
  }
  CHECK(base::sum(MPI_COMM_WORLD, refused) > 0);
  CHECK(base::sum(MPI_COMM_WORLD, taken) > 0);
}

TEST_CASE("on the same mesh in another partition every vertex gets its own load") {
  const mesh::WholeMesh whole = mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {7, 6, 0});
  const mesh::Mesh to = mesh::distribute(MPI_COMM_WORLD, whole);
  // Cells dealt out like cards.
  std::vector<std::int32_t> ranks(whole.num_cells());
  for (std::size_t cell = 0; cell < ranks.size(); ++cell) {
    ranks[cell] = static_cast<std::int32_t>(cell) % base::size(MPI_COMM_WORLD);
  }
  const mesh::Mesh from = mesh::build_mesh(MPI_COMM_WORLD, mesh::scatter(MPI_COMM_WORLD, whole, ranks));
  const fem::Space from_space = fem::lagrange(from, 1), to_space = fem::lagrange(to, 1);
  const auto source = [](double x, double y) { return std::sin(5 * x) + y * y; };
  fem::Load expected = load_of(to_space, source), load(to_space, 1);
  expected.add_to_owners();
  PointInterpolation(to, from.coordinates).restrict_to(load_of(from_space, source).values, load);
  for (std::size_t i = 0; i < load.values.size(); ++i)
    CHECK(load.values[i] == Approx(expected.values[i]).margin(1e-15));
}

TEST_CASE("integrals of a smooth source against a smooth function converge with second order on meshes that differ") {
  const auto source = [](double x, double y) { return std::exp(x - y); };
  const double exact = (std::exp(3.0) - 1) / 3 * (std::exp(1.0) - 1);
  std::vector<double> errors;
  for (const int level : {1, 2, 4}) {
    const mesh::Mesh flow = unit_square(11 * level), acoustic = unit_square(7 * level);
    const fem::Space flow_space = fem::lagrange(flow, 1), space = fem::lagrange(acoustic, 1);
    const fem::Load given = load_of(flow_space, source);
    fem::Load load(space, 1);
    const PointInterpolation interpolation(acoustic, flow.coordinates);
    interpolation.restrict_to(given.values, load);
    CHECK(interpolation.outside().count == 0);
    CHECK(sum_of(MPI_COMM_WORLD, load.values) == Approx(sum_of(MPI_COMM_WORLD, given.values)).epsilon(1e-14));
    const fem::Field test =
        fem::interpolate(space, 1, [](auto x, auto values) { values[0] = std::exp(2 * x[0] + 2 * x[1]); });
    errors.push_back(std::abs(product(MPI_COMM_WORLD, load.values, test.values) / exact - 1));
  }
  CHECK(std::log2(errors[0] / errors[1]) == Approx(2).margin(0.2));
  CHECK(std::log2(errors[1] / errors[2]) == Approx(2).margin(0.2));
}

TEST_CASE("the load is the same on any number of ranks") {
  const auto source = [](double x, double y) { return std::exp(x - y); };
  const mesh::WholeMesh fine = mesh::box(MPI_COMM_SELF, {1, 1, 0}, {11, 9, 0});
  const mesh::WholeMesh coarse = mesh::box(MPI_COMM_SELF, {1, 1, 0}, {6, 7, 0});
  const mesh::Mesh flow_alone = mesh::distribute(MPI_COMM_SELF, fine);
  const mesh::Mesh alone = mesh::distribute(MPI_COMM_SELF, coarse);
  const fem::Space flow_alone_space = fem::lagrange(flow_alone, 1), alone_space = fem::lagrange(alone, 1);
  fem::Load expected(alone_space, 1);
  PointInterpolation(alone, flow_alone.coordinates).restrict_to(load_of(flow_alone_space, source).values, expected);
  std::map<std::int64_t, double> by_input;
  for (std::int32_t v = 0; v < alone.num_vertices(); ++v) by_input[alone.vertex_input[v]] = expected.values[v];

  const mesh::Mesh flow = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {11, 9, 0}));
  const mesh::Mesh acoustic = mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {6, 7, 0}));
  const fem::Space flow_space = fem::lagrange(flow, 1), space = fem::lagrange(acoustic, 1);
  fem::Load load(space, 1);
  PointInterpolation(acoustic, flow.coordinates).restrict_to(load_of(flow_space, source).values, load);
  for (std::int32_t v = 0; v < acoustic.vertices.num_owned; ++v) {
    CHECK(load.values[v] == Approx(by_input[acoustic.vertex_input[v]]).epsilon(1e-12));
  }
}
