#include "transfer/strip.hpp"

#include "core/base/mpi.hpp"
#include "core/mesh/generate.hpp"
#include "tests/all_ranks.hpp"
#include "tests/transfer/random_case.hpp"
#include "tests/transfer/strip_check.hpp"
#include "tests/transfer/world_split.hpp"

using namespace vocalis;
using namespace vocalis::transfer;

namespace {

using Integers = std::vector<std::int32_t>;
using Numbers = std::vector<std::int64_t>;

struct Tally {
  std::int64_t strips = 0, moved_owners = 0, empty_ranks = 0, nothing_left = 0;
};

/// One random mesh, two strips of it; checked by brute force.
void strip_one(MPI_Comm comm, std::uint64_t seed, Tally& tally) {
  Random random(seed);
  const RandomCase test = random_case(random, base::size(comm));
  const mesh::Mesh parent = test.distribute(comm);
  const std::vector<std::int32_t> first_mask = random_mask(random, test), second_mask = random_mask(random, test);
  const StrippedMesh first = strip(parent, mask_of_rank(test, first_mask, base::rank(comm)));
  const StrippedMesh second = strip(parent, mask_of_rank(test, second_mask, base::rank(comm)));
  INFO("seed " << seed << " on " << base::size(comm) << " ranks");
  CHECK(check_strip(test, first_mask, parent, first) == "");
  CHECK(check_strip(test, second_mask, parent, second) == "");
  for (const StrippedMesh* one : {&first, &second}) {
    std::int32_t moved = 0;
    for (std::int32_t i = 0; i < one->mesh.vertices.num_owned; ++i) {
      if (one->vertex_to_parent[i] >= parent.vertices.num_owned) moved = 1;
    }
    moved = base::largest(comm, moved);
    const auto fewest = base::smallest(comm, one->mesh.num_cells());
    if (base::rank(comm) != 0) continue;
    ++tally.strips;
    tally.moved_owners += moved;
    tally.empty_ranks += fewest == 0;
    tally.nothing_left += one->mesh.cells.num_global == 0;
  }
}

/// Two groups of ranks at a time, [0, n) and [n, size), for all n in turn, until there are enough strips.
Tally strip_many(std::int64_t wanted, std::uint64_t seed) {
  const WorldSplits splits;
  Tally tally;
  for (std::int64_t done = 0, trial = 0; done < wanted; ++trial) {
    const auto& split = splits.turn(trial);
    strip_one(split.comm, seed + 2 * trial + (split.is_upper ? 1 : 0), tally);
    done += 2 * split.groups;
  }
  for (std::int64_t* count : {&tally.strips, &tally.moved_owners, &tally.empty_ranks, &tally.nothing_left}) {
    *count = base::sum(MPI_COMM_WORLD, *count);
  }
  return tally;
}

}  // namespace

TEST_CASE("random strips of random partitions are what brute force says") {
  const Tally tally = strip_many(400, 1);
  CHECK(tally.strips >= 400);
  CHECK(tally.nothing_left > 0);
  if (base::size(MPI_COMM_WORLD) > 1) {
    CHECK(tally.moved_owners > 0);
    CHECK(tally.empty_ranks > 0);
  }
}

TEST_CASE("ten thousand random strips of random partitions are what brute force says", "[.long][strips]") {
  const Tally tally = strip_many(10000, 1000000);
  CHECK(tally.strips >= 10000);
  if (base::rank(MPI_COMM_WORLD) == 0) {
    WARN(tally.strips << " strips, " << tally.moved_owners << " moved an owner, " << tally.empty_ranks
                      << " had a rank without cells, " << tally.nothing_left << " kept nothing");
  }
}

namespace {

// Two ranks, a 2 x 1 box of four triangles; vertices by number, cells by letter:
//
//   3 --- 4 --- 5        a = 0 1 4,  c = 1 2 5  (below the diagonals)
//   | b / | d / |        b = 0 4 3,  d = 1 5 4  (above)
//   |  /  |  /  |        rank 0 has a and d, rank 1 has b and c
//   | / a | / c |
//   0 --- 1 --- 2
//
// In the parent rank 0 owns 0 1 4 5 and has no ghosts; rank 1 owns the two that are left, and has four ghosts.
class DrawnMesh {
 public:
  DrawnMesh() : split_(splits_.first(2)), here_(base::rank(split_.comm)) {
    if (split_.is_upper) return;
    // The generator lists a brick's cells below the diagonal first: a, b, c, d.
    const mesh::WholeMesh whole = mesh::box(split_.comm, {2, 1, 0}, {2, 1, 0});
    parent = mesh::build_mesh(split_.comm, mesh::scatter(split_.comm, whole, {0, 1, 1, 0}));
  }
  bool is_here(int rank) const { return !split_.is_upper && here_ == rank; }
  bool is_anywhere() const { return !split_.is_upper; }
  StrippedMesh keep(const Integers& on_rank_0, const Integers& on_rank_1) const {
    return strip(parent, here_ == 0 ? on_rank_0 : on_rank_1);
  }
  mesh::Mesh parent;

 private:
  WorldSplits splits_;
  WorldSplits::Split split_;
  int here_;
};

bool has_two_ranks() { return base::size(MPI_COMM_WORLD) > 1; }

}  // namespace

TEST_CASE("the drawn mesh has its parent arrays as drawn") {
  if (!has_two_ranks()) return;
  const DrawnMesh drawn;
  const mesh::Mesh& parent = drawn.parent;
  if (drawn.is_here(0)) {
    CHECK(parent.vertex_input == Numbers{0, 1, 4, 5});
    CHECK(parent.vertices.num_ghosts() == 0);
  }
  if (drawn.is_here(1)) {
    CHECK(parent.vertex_input == Numbers{3, 2, 0, 4, 1, 5});
    CHECK(parent.vertices.num_owned == 2);
    CHECK(parent.vertices.ghost_owner == std::vector<int>{0, 0, 0, 0});
    CHECK(parent.vertices.ghost_global == Numbers{0, 2, 1, 3});
  }
}

TEST_CASE("without cell a, vertex 0 moves to rank 1") {
  if (!has_two_ranks()) return;
  const DrawnMesh drawn;
  if (!drawn.is_anywhere()) return;
  const StrippedMesh stripped = drawn.keep({0, 1}, {1, 1});
  const mesh::Mesh& mesh = stripped.mesh;
  CHECK(mesh.vertices.num_global == 6);
  CHECK(mesh.cells.num_global == 3);
  CHECK(mesh.edges.num_global == 8);
  if (drawn.is_here(0)) {
    CHECK(mesh.vertex_input == Numbers{1, 4, 5});
    CHECK(mesh.vertices.num_owned == 3);
    CHECK(stripped.vertex_to_parent == Integers{1, 2, 3});
    CHECK(stripped.parent_to_vertex == Integers{-1, 0, 1, 2});
    CHECK(stripped.cell_to_parent == Integers{1, 3});
    CHECK(stripped.parent_to_cell == Integers{-1, 0, -1, 1});
    CHECK(mesh.cells.ghost_owner == std::vector<int>{1});
    CHECK(mesh.cells.ghost_global == Numbers{2});
  }
  if (drawn.is_here(1)) {
    CHECK(mesh.vertex_input == Numbers{3, 2, 0, 4, 1, 5});
    CHECK(mesh.vertices.num_owned == 3);
    CHECK(mesh.vertices.offset == 3);
    CHECK(mesh.vertices.ghost_owner == std::vector<int>{0, 0, 0});
    CHECK(mesh.vertices.ghost_global == Numbers{1, 0, 2});
    CHECK(stripped.vertex_to_parent == Integers{0, 1, 2, 3, 4, 5});
    CHECK(stripped.parent_to_vertex == Integers{0, 1, 2, 3, 4, 5});
  }
}

TEST_CASE("with cell b alone, rank 0 is empty and rank 1 owns the three vertices") {
  if (!has_two_ranks()) return;
  const DrawnMesh drawn;
  if (!drawn.is_anywhere()) return;
  const StrippedMesh stripped = drawn.keep({0, 0}, {1, 0});
  const mesh::Mesh& mesh = stripped.mesh;
  CHECK(mesh.vertices.num_global == 3);
  CHECK(mesh.edges.num_global == 3);
  CHECK(mesh.cells.num_ghosts() == 0);
  if (drawn.is_here(0)) {
    CHECK(mesh.num_vertices() == 0);
    CHECK(stripped.parent_to_vertex == Integers{-1, -1, -1, -1});
  }
  if (drawn.is_here(1)) {
    CHECK(mesh.vertex_input == Numbers{3, 0, 4});
    CHECK(mesh.vertices.num_owned == 3);
    CHECK(stripped.parent_to_vertex == Integers{0, -1, 1, 2, -1, -1});
    CHECK(mesh.cell_neighbours == Integers{-1, -1, -1});
    // Left and top; the diagonal has become exterior and has no group.
    CHECK(mesh.named_facets.size() == 2);
  }
}

TEST_CASE("coordinates follow those of the parent") {
  if (!has_two_ranks()) return;
  DrawnMesh drawn;
  if (!drawn.is_anywhere()) return;
  StrippedMesh stripped = drawn.keep({0, 0}, {1, 1});
  for (double& x : drawn.parent.coordinates) x = 2 * x + 1;
  follow(stripped, drawn.parent.coordinates);
  for (std::int32_t i = 0; i < stripped.mesh.num_vertices(); ++i) {
    CHECK(stripped.mesh.point(i)[0] == 1 + 2.0 * static_cast<double>(stripped.mesh.vertex_input[i] % 3));
    CHECK(stripped.mesh.point(i)[1] == 1 + 2.0 * static_cast<double>(stripped.mesh.vertex_input[i] / 3));
  }
}
