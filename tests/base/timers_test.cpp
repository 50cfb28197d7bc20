#include "core/base/timers.hpp"

#include <chrono>
#include <thread>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis::base;

TEST_CASE("a scope adds its seconds to its phase") {
  Timers timers;
  for (int i = 0; i < 2; ++i) {
    const auto scope = timers.scope("flow.assemble");
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  REQUIRE(timers.phases().size() == 1);
  CHECK(timers.phases()[0].seconds >= 0.01);
  CHECK(timers.phases()[0].calls == 2);
}

TEST_CASE("the report takes the largest seconds of any rank, also of phases that some ranks lack") {
  const int here = rank(MPI_COMM_WORLD);
  const int ranks = size(MPI_COMM_WORLD);
  Timers timers;
  timers.add("flow", 1.0 + here);
  if (here == ranks - 1) timers.add("sound", 7);
  const std::vector<Timers::Phase> phases = largest_over_ranks(MPI_COMM_WORLD, timers.phases());
  REQUIRE_ON_ALL_RANKS(phases.size() == 2);
  CHECK(phases[0].name == "flow");
  CHECK(phases[0].seconds == ranks);
  CHECK(phases[1].name == "sound");
  CHECK(phases[1].seconds == 7);
}
