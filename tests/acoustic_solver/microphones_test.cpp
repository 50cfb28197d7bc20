#include "acoustic_solver/microphones.hpp"

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::acoustic {
namespace {

mesh::Mesh square() { return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, {1, 1, 0}, {8, 8, 0})); }

std::vector<double> plane(const mesh::Mesh& mesh, double scale) {
  std::vector<double> values;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    values.push_back(scale * (1 + 2 * mesh.point(v)[0] - 3 * mesh.point(v)[1]));
  }
  return values;
}

const std::vector<MicrophoneSettings> three = {
    {"mouth", {0.9, 0.31, 0}}, {"nose", {0.13, 0.77, 0}}, {"ear", {0.5, 0.5, 0}}};

}  // namespace

TEST_CASE("microphones sample a linear field exactly, on any rank, and rank 0 gets the block") {
  const mesh::Mesh mesh = square();
  Microphones microphones(mesh, three);
  CHECK(microphones.outside().empty());
  for (int n = 1; n <= 3; ++n) microphones.sample(0.1 * n, plane(mesh, n));
  CHECK(microphones.state().times.size() == 3);
  const auto block = microphones.collect();
  CHECK(microphones.state().times.empty());
  REQUIRE_ON_ALL_RANKS(block.values.size() == (base::rank(mesh.comm) == 0 ? 9u : 0u));
  if (base::rank(mesh.comm) == 0) {
    CHECK(block.times == std::vector<double>{0.1, 0.2, 0.1 * 3});
    for (int n = 0; n < 3; ++n) {
      CHECK(block.values[3 * n] == Approx((n + 1) * (1 + 1.8 - 0.93)));
      CHECK(block.values[3 * n + 1] == Approx((n + 1) * (1 + 0.26 - 2.31)));
      CHECK(block.values[3 * n + 2] == Approx((n + 1) * 0.5));
    }
  }
}

TEST_CASE("microphones that no cell contains are named on every rank") {
  const mesh::Mesh mesh = square();
  const Microphones microphones(mesh, {{"in", {0.5, 0.2, 0}}, {"out", {1.5, 0.2, 0}}});
  CHECK(microphones.outside() == std::vector<std::string>{"out"});
  CHECK_THROWS_WITH(microphones.require_inside(), Catch::Contains("outside: out"));
}

TEST_CASE("a microphone stays where it is when its mesh moves") {
  mesh::Mesh mesh = square();
  Microphones microphones(mesh, three);
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double& x = mesh.coordinates[2 * static_cast<std::size_t>(v)];
    x += 0.3 * x * (1 - x);
  }
  microphones.follow(mesh);
  microphones.sample(1, plane(mesh, 1));
  const auto block = microphones.collect();
  if (base::rank(mesh.comm) == 0) {
    CHECK(block.values[0] == Approx(1 + 1.8 - 0.93));
    CHECK(block.values[1] == Approx(1 + 0.26 - 2.31));
    CHECK(block.values[2] == Approx(0.5));
  }
}

TEST_CASE("samples not yet collected survive in the state") {
  const mesh::Mesh mesh = square();
  Microphones first(mesh, three), second(mesh, three);
  first.sample(0.5, plane(mesh, 1));
  second.set_state(first.state());
  const auto one = first.collect(), two = second.collect();
  CHECK(one.values == two.values);
  CHECK(one.times == two.times);
}

}  // namespace vocalis::acoustic
