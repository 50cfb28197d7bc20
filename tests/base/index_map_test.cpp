#include "core/base/index_map.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::base;

TEST_CASE("an index map without ghosts is contiguous over the ranks") {
  const int here = rank(MPI_COMM_WORLD), ranks = size(MPI_COMM_WORLD);
  // Rank r owns r indices, so rank 0 owns none.
  const IndexMap map = contiguous_index_map(MPI_COMM_WORLD, here);
  CHECK(map.num_owned == here);
  CHECK(map.num_ghosts() == 0);
  CHECK(map.offset == here * (here - 1) / 2);
  CHECK(map.num_global == ranks * (ranks - 1) / 2);
  if (here > 0) CHECK(map.to_global(here - 1) == map.offset + here - 1);
}

// Rank 0 lists the keys 7 3 9, rank 1 lists 3 8 7 1. Rank 0 owns all of its own (local 0 1 2, global 0 1 2); rank 1
// owns 8 and 1 (local 0 1, global 3 4), and has the ghosts 3 (local 2) and 7 (local 3).
TEST_CASE("shared keys belong to the lowest rank, owned and ghosts in the order given") {
  if (size(MPI_COMM_WORLD) != 2) return;
  const bool first = rank(MPI_COMM_WORLD) == 0;
  const auto keys = first ? std::vector<std::int64_t>{7, 3, 9} : std::vector<std::int64_t>{3, 8, 7, 1};
  const SharedNumbering numbering = number_shared(MPI_COMM_WORLD, keys);
  CHECK(numbering.map.num_global == 5);
  if (first) {
    CHECK(numbering.map.num_owned == 3);
    CHECK(numbering.map.num_ghosts() == 0);
    CHECK(numbering.key_to_local == std::vector<std::int32_t>{0, 1, 2});
  } else {
    CHECK(numbering.map.num_owned == 2);
    CHECK(numbering.map.offset == 3);
    CHECK(numbering.key_to_local == std::vector<std::int32_t>{2, 0, 3, 1});
    CHECK(numbering.map.ghost_global == std::vector<std::int64_t>{1, 0});
    CHECK(numbering.map.ghost_owner == std::vector<int>{0, 0});
    CHECK(numbering.map.to_global(1) == 4);
    CHECK(numbering.map.to_global(3) == 0);
  }
}

TEST_CASE("nobody has any key") {
  const SharedNumbering numbering = number_shared(MPI_COMM_WORLD, {});
  CHECK(numbering.map.num_global == 0);
  CHECK(numbering.map.num_local() == 0);
}

TEST_CASE("random keys get one number each, the same on every rank") {
  const int here = rank(MPI_COMM_WORLD), ranks = size(MPI_COMM_WORLD);
  for (unsigned trial = 0; trial < 20; ++trial) {
    // Every rank knows the lists of all; rank r is empty in trial r.
    std::mt19937 random(trial);
    std::vector<std::vector<std::int64_t>> keys(ranks);
    std::map<std::int64_t, int> owner;
    for (int r = 0; r < ranks; ++r) {
      for (std::int64_t key = 0; key < 60; ++key) {
        if (random() % 3 != 0 || static_cast<unsigned>(r) == trial) continue;
        keys[r].push_back((key * 37) % 101);
        owner.try_emplace(keys[r].back(), r);
      }
    }
    const SharedNumbering numbering = number_shared(MPI_COMM_WORLD, keys[here]);
    CHECK(numbering.map.num_global == static_cast<std::int64_t>(owner.size()));
    std::vector<std::int64_t> by_global(numbering.map.num_global, -1), largest_seen(numbering.map.num_global, -1);
    bool right = true;
    for (std::size_t i = 0; i < keys[here].size(); ++i) {
      const std::int32_t local = numbering.key_to_local[i];
      by_global[numbering.map.to_global(local)] = keys[here][i];
      const int its_owner =
          local < numbering.map.num_owned ? here : numbering.map.ghost_owner[local - numbering.map.num_owned];
      right = right && its_owner == owner.at(keys[here][i]);
    }
    CHECK(right);
    MPI_Allreduce(by_global.data(), largest_seen.data(), static_cast<int>(by_global.size()), MPI_INT64_T, MPI_MAX,
                  MPI_COMM_WORLD);
    for (std::size_t g = 0; g < by_global.size(); ++g) {
      right = right && (by_global[g] < 0 || by_global[g] == largest_seen[g]);
    }
    CHECK(right);
    CHECK(std::set<std::int64_t>(largest_seen.begin(), largest_seen.end()).size() == owner.size());
    CHECK(std::count(largest_seen.begin(), largest_seen.end(), -1) == 0);
  }
}
