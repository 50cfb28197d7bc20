#include "core/la/substructuring.hpp"

#include "core/la/separator.hpp"
#include "tests/all_ranks.hpp"
#include "tests/la/chain.hpp"
#include "tests/la/strip.hpp"

using namespace vocalis;
using namespace vocalis::la;

TEST_CASE("without the separator no rank couples with another, and where the lowest owns, it is what is shared") {
  const Chain chain;
  AssembledMatrix matrix(chain.layout, chain.rows, 2, {});
  const std::vector<PetscInt> separator = find_separator(matrix.get());
  REQUIRE(separator.size() == static_cast<std::size_t>(base::size(MPI_COMM_WORLD) - 1));
  for (std::size_t r = 0; r < separator.size(); ++r) CHECK(separator[r] == static_cast<PetscInt>(3 * (r + 1)));
}

TEST_CASE("an unknown that another rank's row alone couples with belongs to the separator") {
  const Chain chain;
  // Rows of shared points are held: only the next rank's rows couple with them.
  std::vector<PetscInt> held;
  const int ranks = base::size(MPI_COMM_WORLD), here = base::rank(MPI_COMM_WORLD);
  if (here < ranks - 1) held = {chain.layout.num_owned() - 1};
  AssembledMatrix matrix(chain.layout, chain.rows, 2, held);
  CHECK(find_separator(matrix.get()).size() == static_cast<std::size_t>(ranks - 1));
}

TEST_CASE("substructuring solves a system without symmetry, and follows it") {
  for (const int along : {1, 2, 9}) {  // with 1, all unknowns but the last rank's are shared
    Strip strip(along);
    Substructuring factors(strip.matrix.get(), find_separator(strip.matrix.get()));
    const auto solve = [&](Vec b, Vec x) { factors.solve(b, x); };
    REQUIRE_ON_ALL_RANKS(factors.factorise());
    CHECK(strip.residual(solve) < 1e-13);
    strip.fill(3);
    CHECK(strip.residual(solve) > 1e-3);
    REQUIRE_ON_ALL_RANKS(factors.factorise());
    CHECK(strip.residual(solve) < 1e-13);
  }
}

TEST_CASE("a singular system is told by every rank") {
  const Chain chain;
  AssembledMatrix matrix(chain.layout, chain.rows, 2, {});
  Substructuring factors(matrix.get(), find_separator(matrix.get()));
  CHECK_FALSE(factors.factorise());
}
