#include "transfer/carry.hpp"

#include <cmath>
#include <set>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/transfer/random_case.hpp"
#include "tests/transfer/world_split.hpp"

using namespace vocalis;
using namespace vocalis::transfer;

namespace {

constexpr double absent = -7;

double value_at(std::int64_t vertex, int component) {
  return std::sin(1.0 + 3.0 * static_cast<double>(vertex) + component);
}

/// Vertices of the whole mesh that a mask keeps.
std::set<std::int64_t> kept_vertices(const RandomCase& test, const std::vector<std::int32_t>& mask) {
  std::set<std::int64_t> result;
  const int corners = test.whole.dimension + 1;
  for (std::int64_t cell = 0; cell < test.whole.num_cells(); ++cell) {
    if (!mask[cell]) continue;
    const auto first = test.whole.cell_vertices.begin() + cell * corners;
    result.insert(first, first + corners);
  }
  return result;
}

/// A mesh of the family: the parent itself, or a strip of it.
struct Member {
  const mesh::Mesh& mesh;
  std::set<std::int64_t> vertices;
};

void check_carry(const SharedVertices& shared, const Member& from, const Member& to, Random& random) {
  const fem::Space from_space = fem::lagrange(from.mesh, 1), to_space = fem::lagrange(to.mesh, 1);
  fem::Field field(from_space, 2), carried(to_space, 2);
  for (std::int32_t i = 0; i < from.mesh.num_vertices(); ++i) {
    for (int c = 0; c < 2; ++c) field.at(i)[c] = value_at(from.mesh.vertex_input[i], c);
  }
  shared.carry(field, carried, absent);
  bool exact = true, told = true;
  for (std::int32_t i = 0; i < to.mesh.num_vertices(); ++i) {
    const bool has = from.vertices.contains(to.mesh.vertex_input[i]);
    told = told && (shared.is_shared()[i] != 0) == has;
    for (int c = 0; c < 2; ++c) {
      exact = exact && carried.at(i)[c] == (has ? value_at(to.mesh.vertex_input[i], c) : absent);
    }
  }
  CHECK(exact);
  CHECK(told);

  // Contributions of each rank at all of its copies, not yet summed; those at vertices that `to` lacks are lost.
  fem::Load load(from_space, 2), received(to_space, 2);
  double given = 0, size = 0, total = 0;
  for (std::int32_t i = 0; i < from.mesh.num_vertices(); ++i) {
    for (int c = 0; c < 2; ++c) {
      load.at(i)[c] = 1e-3 * static_cast<double>(draw(random, 2000) - 1000);
      if (!to.vertices.contains(from.mesh.vertex_input[i])) continue;
      given += load.at(i)[c];
      size += std::abs(load.at(i)[c]);
    }
  }
  shared.carry(load, received);
  for (const double value : received.values) total += value;
  MPI_Comm comm = from.mesh.comm;
  given = base::sum(comm, given);
  size = base::sum(comm, size);
  CHECK(std::abs(base::sum(comm, total) - given) <= 1e-14 * size);

  // Transposes of each other: <carried load, field> = <load, carried field> with the field on `to`.
  fem::Field test(to_space, 2), back(from_space, 2);
  for (std::int32_t i = 0; i < to.mesh.num_vertices(); ++i) {
    for (int c = 0; c < 2; ++c) test.at(i)[c] = value_at(to.mesh.vertex_input[i], c);
  }
  for (std::int32_t i = 0; i < from.mesh.num_vertices(); ++i) {
    for (int c = 0; c < 2; ++c) {
      const bool has = to.vertices.contains(from.mesh.vertex_input[i]);
      back.at(i)[c] = has ? value_at(from.mesh.vertex_input[i], c) : 0;
    }
  }
  double there = 0, here = 0;
  for (std::size_t i = 0; i < received.values.size(); ++i) there += received.values[i] * test.values[i];
  for (std::size_t i = 0; i < load.values.size(); ++i) here += load.values[i] * back.values[i];
  CHECK(std::abs(base::sum(comm, there) - base::sum(comm, here)) <= 1e-14 * size);
}

void carry_every_way(MPI_Comm comm, std::uint64_t seed) {
  Random random(seed);
  const RandomCase test = random_case(random, base::size(comm));
  const auto first_mask = random_mask(random, test), second_mask = random_mask(random, test);
  random.discard(base::rank(comm));
  const mesh::Mesh parent = test.distribute(comm);
  const StrippedMesh first = strip(parent, mask_of_rank(test, first_mask, base::rank(comm)));
  const StrippedMesh second = strip(parent, mask_of_rank(test, second_mask, base::rank(comm)));
  const Member whole = {parent, kept_vertices(test, std::vector<std::int32_t>(test.whole.num_cells(), 1))};
  const Member one = {first.mesh, kept_vertices(test, first_mask)};
  const Member two = {second.mesh, kept_vertices(test, second_mask)};
  INFO("seed " << seed << " on " << base::size(comm) << " ranks");
  check_carry(SharedVertices::from_parent(parent, first), whole, one, random);
  check_carry(SharedVertices::to_parent(parent, first), one, whole, random);
  check_carry(SharedVertices::between(parent, first, second), one, two, random);
}

}  // namespace

TEST_CASE("fields are carried exactly and loads keep their total, every way") {
  const WorldSplits splits;
  for (int trial = 0; trial < 60; ++trial) {
    const auto& split = splits.turn(trial);
    carry_every_way(split.comm, 5000 + 2 * trial + split.is_upper);
  }
}
