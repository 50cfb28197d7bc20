#include "core/la/system_layout.hpp"

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

namespace {

bool are_two_ranks() { return base::size(MPI_COMM_WORLD) == 2; }
bool is_first() { return base::rank(MPI_COMM_WORLD) == 0; }

}  // namespace

// Velocity (2 components): rank 0 owns indices 0 1 and has the ghost 2; rank 1 owns 2, and has the ghost 0.
// Pressure (1 component):  rank 0 owns 0;     rank 1 owns 1 2, and has the ghost 0.
// Rows of rank 0: v0 v0 v1 v1 p0 = 0..4; of rank 1: v2 v2 p1 p2 = 5..8.
TEST_CASE("two fields on two ranks stand where drawn") {
  if (!are_two_ranks()) return;
  base::IndexMap velocity = base::contiguous_index_map(MPI_COMM_WORLD, is_first() ? 2 : 1);
  velocity.ghost_global = {is_first() ? 2 : 0};
  velocity.ghost_owner = {is_first() ? 1 : 0};
  base::IndexMap pressure = base::contiguous_index_map(MPI_COMM_WORLD, is_first() ? 1 : 2);
  if (!is_first()) {
    pressure.ghost_global = {0};
    pressure.ghost_owner = {0};
  }
  const la::SystemLayout layout(MPI_COMM_WORLD, {{&velocity, 2}, {&pressure, 1}});
  CHECK(layout.components(0) == 2);
  if (is_first()) {
    CHECK(layout.num_owned() == 5);
    CHECK(layout.offset() == 0);
    CHECK(layout.start(1) == 4);
    CHECK(layout.global(0, 1, 1) == 3);
    CHECK(layout.global(0, 2, 0) == 5);
    CHECK(layout.global(1, 0, 0) == 4);
  } else {
    CHECK(layout.num_owned() == 4);
    CHECK(layout.offset() == 5);
    CHECK(layout.start(1) == 2);
    CHECK(layout.global(0, 0, 1) == 6);
    CHECK(layout.global(0, 1, 1) == 1);
    CHECK(layout.global(1, 1, 0) == 8);
    CHECK(layout.global(1, 2, 0) == 4);
  }
}

TEST_CASE("owned rows go to the system's vector and back") {
  const int here = base::rank(MPI_COMM_WORLD);
  const base::IndexMap first = base::contiguous_index_map(MPI_COMM_WORLD, 1 + here);
  const base::IndexMap second = base::contiguous_index_map(MPI_COMM_WORLD, 2);
  const la::SystemLayout layout(MPI_COMM_WORLD, {{&first, 3}, {&second, 1}});
  std::vector<double> values(3 * (1 + here)), other = {-1, -2}, system(layout.num_owned(), 0.0);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = 1.0 + static_cast<double>(i);
  layout.copy_owned_to_system(0, values, system.data());
  layout.copy_owned_to_system(1, other, system.data());
  CHECK(system.front() == 1);
  CHECK(system[layout.start(1)] == -1);
  CHECK(system.back() == -2);
  std::vector<double> back(values.size(), 0.0), other_back(2, 0.0);
  layout.copy_owned(0, system.data(), back);
  layout.copy_owned(1, system.data(), other_back);
  CHECK(back == values);
  CHECK(other_back == other);
}
