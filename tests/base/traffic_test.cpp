#include "core/base/traffic.hpp"

#include <mpi.h>
#include <petscvec.h>

#include <vector>

#include "core/base/error.hpp"
#include "core/base/halo.hpp"
#include "core/base/mpi.hpp"
#include "core/base/timers.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis::base;

namespace {

/// What this rank sends in the course of an action.
template <class Action>
Traffic of(const Action& action) {
  const Traffic before = traffic();
  action();
  Traffic sent = traffic();
  sent -= before;
  return sent;
}

/// Three indices on each rank, and a ghost of the next rank's first one.
IndexMap ring() {
  const int ranks = size(MPI_COMM_WORLD), next = (rank(MPI_COMM_WORLD) + 1) % ranks;
  IndexMap map = contiguous_index_map(MPI_COMM_WORLD, 3);
  if (ranks > 1) {
    map.ghost_global = {3 * next};
    map.ghost_owner = {next};
  }
  return map;
}

}  // namespace

TEST_CASE("a halo's messages are counted with their bytes, whoever begins them, again and again") {
  const IndexMap map = ring();
  const Halo halo(map);
  std::vector<double> values(2 * map.num_local(), 1.0);
  const std::int64_t one = size(MPI_COMM_WORLD) > 1;
  for (int repetition = 0; repetition < 3; ++repetition) {
    const Traffic copied = of([&] { halo.copy_to_ghosts(values, 2); });
    CHECK(copied.messages == one);
    CHECK(copied.bytes == 16 * one);
    CHECK(copied.reductions == 0);
    const Traffic added = of([&] { halo.add_to_owners(std::span(values).first(map.num_local())); });
    CHECK(added.messages == one);
    CHECK(added.bytes == 8 * one);
  }
}

TEST_CASE("reductions are counted with what a rank hands in, ours and PETSc's; those of one rank are not") {
  const bool several = size(MPI_COMM_WORLD) > 1;
  const Traffic ours = of([] { sum(MPI_COMM_WORLD, 1.0); });
  CHECK(ours.reductions == (several ? 1 : 0));
  CHECK(ours.reduction_bytes == (several ? 8 : 0));
  CHECK(ours.messages == 0);
  CHECK(of([] { sum(MPI_COMM_SELF, 1.0); }).reductions == 0);
  Vec vector = nullptr;
  check(VecCreateMPI(MPI_COMM_WORLD, 5, PETSC_DETERMINE, &vector));
  check(VecSet(vector, 1));
  double square = 0;
  const Traffic theirs = of([&] { check(VecDot(vector, vector, &square)); });
  CHECK(theirs.reductions == (several ? 1 : 0));
  CHECK(square == 5 * size(MPI_COMM_WORLD));
  check(VecDestroy(&vector));
}

TEST_CASE("a gather in place is a reduction to which its caller hands in nothing that is known") {
  const int ranks = size(MPI_COMM_WORLD);
  std::vector<int> values(ranks, 0);
  values[rank(MPI_COMM_WORLD)] = 7;
  const Traffic sent =
      of([&] { MPI_Allgather(MPI_IN_PLACE, 3, MPI_DOUBLE, values.data(), 1, MPI_INT, MPI_COMM_WORLD); });
  CHECK(values == std::vector<int>(ranks, 7));
  CHECK(sent.reductions == (ranks > 1 ? 1 : 0));
  CHECK(sent.reduction_bytes == 0);
}

TEST_CASE("a phase holds what was sent in it, and the report the most of any rank") {
  const int ranks = size(MPI_COMM_WORLD), here = rank(MPI_COMM_WORLD);
  Timers timers;
  sum(MPI_COMM_WORLD, 1.0);
  {
    const auto scope = timers.scope("sound");
    sum(MPI_COMM_WORLD, 1.0);
    const int value = 0;
    int received = 0;
    const int next = here + 1 < ranks ? here + 1 : MPI_PROC_NULL;
    const int last = here > 0 ? here - 1 : MPI_PROC_NULL;
    MPI_Sendrecv(&value, 1, MPI_INT, next, 0, &received, 1, MPI_INT, last, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
  }
  REQUIRE_ON_ALL_RANKS(timers.phases().size() == 1);
  const std::int64_t one = ranks > 1;
  CHECK(timers.phases()[0].traffic.reductions == one);
  CHECK(timers.phases()[0].traffic.messages == (here + 1 < ranks ? 1 : 0));
  const auto phases = largest_over_ranks(MPI_COMM_WORLD, timers.phases());
  CHECK(phases[0].traffic.messages == one);
  CHECK(phases[0].traffic.bytes == 4 * one);
  CHECK(phases[0].traffic.reductions == one);
}

TEST_CASE("a vector that PETSc brings to one rank and back is counted") {
  const bool several = size(MPI_COMM_WORLD) > 1;
  Vec vector = nullptr, whole = nullptr;
  VecScatter scatter = nullptr;
  check(VecCreateMPI(MPI_COMM_WORLD, 5, PETSC_DETERMINE, &vector));
  check(VecScatterCreateToZero(vector, &scatter, &whole));
  const Traffic sent = of([&] {
    check(VecScatterBegin(scatter, vector, whole, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterEnd(scatter, vector, whole, INSERT_VALUES, SCATTER_FORWARD));
    check(VecScatterBegin(scatter, whole, vector, INSERT_VALUES, SCATTER_REVERSE));
    check(VecScatterEnd(scatter, whole, vector, INSERT_VALUES, SCATTER_REVERSE));
  });
  // As messages or as a gather: that is PETSc's affair.
  CHECK((sent.messages + sent.reductions > 0) == several);
  CHECK((sent.bytes + sent.reduction_bytes >= 40) == several);
  check(VecScatterDestroy(&scatter));
  check(VecDestroy(&whole));
  check(VecDestroy(&vector));
}
