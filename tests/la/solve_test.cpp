#include "core/la/solve.hpp"

#include <cmath>

#include "tests/all_ranks.hpp"
#include "tests/la/chain.hpp"

using namespace vocalis;
using namespace vocalis::la;

namespace {

/// The chain with its first point held and a unit load at its last: u_i = i.
struct PulledChain {
  Chain chain;
  AssembledMatrix matrix = AssembledMatrix(chain.layout, chain.rows, 2, chain.ends(false), true);
  PetscVector load = create_vector(MPI_COMM_WORLD, chain.layout.num_owned());
  PetscVector displacement = create_vector(MPI_COMM_WORLD, chain.layout.num_owned());

  PulledChain() {
    matrix.assemble(chain.springs);
    const OwnedValues values(load.get());
    const PetscInt last = chain.num_points - 1 - chain.layout.offset();
    if (last >= 0 && last < chain.layout.num_owned()) values[last] = 1;
  }
  double largest_error() const {
    const ReadValues values(displacement.get());
    double error = 0;
    for (PetscInt i = 0; i < chain.layout.num_owned(); ++i) {
      error = std::max(error, std::abs(values[i] - static_cast<double>(chain.layout.offset() + i)));
    }
    return base::largest(MPI_COMM_WORLD, error);
  }
};

}  // namespace

TEST_CASE("a Krylov solver solves, reports its iterations, and needs none from the answer") {
  PulledChain pulled;
  const PetscLinearSolver solver = create_linear_solver(MPI_COMM_WORLD, {.prefix = "test_chain_"});
  base::check(KSPSetOperators(solver.get(), pulled.matrix.get(), pulled.matrix.get()));
  const SolveReport report = solve(solver.get(), pulled.load.get(), pulled.displacement.get());
  CHECK(report.converged);
  CHECK(report.iterations > 0);
  CHECK(report.iterations <= pulled.chain.num_points);
  CHECK(report.reason.empty());
  CHECK(pulled.largest_error() < 1e-8);
  const SolveReport again = solve(solver.get(), pulled.load.get(), pulled.displacement.get());
  CHECK(again.converged);
  CHECK(again.iterations <= 1);
}

TEST_CASE("a Krylov solver finds back from a guess that is far off") {
  PulledChain pulled;
  const PetscLinearSolver solver =
      create_linear_solver(MPI_COMM_WORLD, {.prefix = "test_guess_", .relative_tolerance = 1e-8});
  base::check(KSPSetOperators(solver.get(), pulled.matrix.get(), pulled.matrix.get()));
  {
    const OwnedValues guess(pulled.displacement.get());
    for (PetscInt i = 0; i < pulled.chain.layout.num_owned(); ++i) guess[i] = i % 2 == 0 ? 1e7 : -1e7;
  }
  const SolveReport report = solve(solver.get(), pulled.load.get(), pulled.displacement.get());
  CHECK(report.converged);
  CHECK(pulled.largest_error() < 1e-5);
}

TEST_CASE("a solver that runs out of iterations says so and does not throw") {
  PulledChain pulled;
  const PetscLinearSolver solver =
      create_linear_solver(MPI_COMM_WORLD, {.prefix = "test_short_", .largest_iterations = 1});
  base::check(KSPSetOperators(solver.get(), pulled.matrix.get(), pulled.matrix.get()));
  const SolveReport report = solve(solver.get(), pulled.load.get(), pulled.displacement.get());
  CHECK_FALSE(report.converged);
  CHECK_FALSE(report.reason.empty());
}
