#include "core/base/first_rank.hpp"

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

using namespace vocalis;

TEST_CASE("work on the first rank is done there alone, and its mistake is known everywhere") {
  std::int32_t calls = 0;
  base::on_first_rank(MPI_COMM_WORLD, [&] { ++calls; });
  CHECK(base::sum(MPI_COMM_WORLD, calls) == 1);
  std::string words;
  try {
    base::on_first_rank(MPI_COMM_WORLD, [] { throw base::UserError("a rule", "a value", "a remedy"); });
  } catch (const base::UserError& error) {
    words = error.what();
  }
  CHECK(words == "a rule\n  found: a value\n  remedy: a remedy");
}
