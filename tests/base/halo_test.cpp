#include "core/base/halo.hpp"

#include <limits>
#include <utility>
#include <vector>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;
using namespace vocalis::base;

namespace {

/// Rank 0 owns the global indices 0 1, rank 1 owns 2 3 4. Rank 0 has the ghosts 4 2, rank 1 the ghost 1.
IndexMap two_rank_map() {
  const bool first = rank(MPI_COMM_WORLD) == 0;
  IndexMap map = contiguous_index_map(MPI_COMM_WORLD, first ? 2 : 3);
  if (first) {
    map.ghost_global = {4, 2};
    map.ghost_owner = {1, 1};
  } else {
    map.ghost_global = {1};
    map.ghost_owner = {0};
  }
  return map;
}

/// Every rank owns one index and has all others as ghosts.
IndexMap all_to_all_map() {
  const int here = rank(MPI_COMM_WORLD);
  IndexMap map = contiguous_index_map(MPI_COMM_WORLD, 1);
  for (int r = 0; r < size(MPI_COMM_WORLD); ++r) {
    if (r == here) continue;
    map.ghost_global.push_back(r);
    map.ghost_owner.push_back(r);
  }
  return map;
}

}  // namespace

TEST_CASE("on two ranks values go where the map says") {
  if (size(MPI_COMM_WORLD) != 2) return;
  const bool first = rank(MPI_COMM_WORLD) == 0;
  const Halo halo(two_rank_map());
  using Reals = std::vector<double>;
  using Integers = std::vector<std::int32_t>;

  Reals values = first ? Reals{10, 11, 0, 0} : Reals{12, 13, 14, 0};
  halo.copy_to_ghosts(values);
  CHECK(values == (first ? Reals{10, 11, 14, 12} : Reals{12, 13, 14, 11}));

  Reals pairs = first ? Reals{1, 2, 3, 4, 0, 0, 0, 0} : Reals{5, 6, 7, 8, 9, 10, 0, 0};
  halo.copy_to_ghosts(pairs, 2);
  CHECK(pairs == (first ? Reals{1, 2, 3, 4, 9, 10, 5, 6} : Reals{5, 6, 7, 8, 9, 10, 3, 4}));

  Reals loads = first ? Reals{1, 2, 3, 4} : Reals{10, 20, 30, 40};
  halo.add_to_owners(loads);
  if (first) CHECK(Reals(loads.begin(), loads.begin() + 2) == Reals{1, 42});
  if (!first) CHECK(Reals(loads.begin(), loads.begin() + 3) == Reals{14, 20, 33});

  Reals load_pairs = first ? Reals{0, 0, 0, 0, 1, 2, 3, 4} : Reals{0, 0, 0, 0, 0, 0, 5, 6};
  halo.add_to_owners(load_pairs, 2);
  if (first) CHECK(Reals(load_pairs.begin(), load_pairs.begin() + 4) == Reals{0, 0, 5, 6});
  if (!first) CHECK(Reals(load_pairs.begin(), load_pairs.begin() + 6) == Reals{3, 4, 0, 0, 1, 2});

  Integers lowest = first ? Integers{1, 9, -5, 7} : Integers{8, 3, 2, 4};
  halo.min_to_owners(lowest);
  if (first) CHECK(Integers(lowest.begin(), lowest.begin() + 2) == Integers{1, 4});
  if (!first) CHECK(Integers(lowest.begin(), lowest.begin() + 3) == Integers{7, 3, -5});

  Integers highest = first ? Integers{1, 9, -5, 70} : Integers{8, 3, 2, 4};
  halo.max_to_owners(highest);
  if (first) CHECK(Integers(highest.begin(), highest.begin() + 2) == Integers{1, 9});
  if (!first) CHECK(Integers(highest.begin(), highest.begin() + 3) == Integers{70, 3, 2});

  Integers integers = first ? Integers{1, 2, 0, 0} : Integers{3, 4, 5, 0};
  halo.copy_to_ghosts(integers);
  CHECK(integers == (first ? Integers{1, 2, 5, 3} : Integers{3, 4, 5, 2}));

  // Wider than a double's 53 bits.
  const std::int64_t large = std::numeric_limits<std::int64_t>::max() - 1;
  std::vector<std::int64_t> wide(first ? 4 : 4, first ? large : -large);
  halo.copy_to_ghosts(wide);
  CHECK(wide.back() == (first ? -large : large));
}

TEST_CASE("an index with a ghost on every rank collects from all of them") {
  const int here = rank(MPI_COMM_WORLD), ranks = size(MPI_COMM_WORLD);
  const Halo halo(all_to_all_map());
  std::vector<double> values(ranks, 1.0 + here);
  halo.add_to_owners(values);
  CHECK(values[0] == ranks * (ranks + 1) / 2);
  std::vector<std::int32_t> ranks_of(ranks, here);
  halo.min_to_owners(ranks_of);
  CHECK(ranks_of[0] == 0);
  ranks_of.assign(ranks, here);
  halo.max_to_owners(ranks_of);
  CHECK(ranks_of[0] == ranks - 1);
}

TEST_CASE("a halo without indices does nothing, and one can be moved") {
  const Halo nothing(contiguous_index_map(MPI_COMM_WORLD, 0));
  std::vector<double> empty;
  nothing.copy_to_ghosts(empty, 3);
  nothing.add_to_owners(empty, 3);

  Halo first(all_to_all_map());
  Halo second(std::move(first));
  Halo third;
  third = std::move(second);
  std::vector<double> values(size(MPI_COMM_WORLD), rank(MPI_COMM_WORLD));
  third.copy_to_ghosts(values);
  double sum = 0;
  for (const double value : values) sum += value;
  CHECK(sum == size(MPI_COMM_WORLD) * (size(MPI_COMM_WORLD) - 1) / 2);
}
