#include "core/la/assembled_matrix.hpp"

#include "tests/all_ranks.hpp"
#include "tests/la/chain.hpp"

using namespace vocalis;
using namespace vocalis::la;

namespace {

/// 2 on the diagonal (1 at free ends), -1 beside it; rows (and columns) of fixed points those of the identity.
std::vector<double> expected(int n, bool fixed, bool drop_columns, double stiffness) {
  std::vector<double> matrix(static_cast<std::size_t>(n) * n, 0.0);
  const auto is_fixed = [&](int i) { return fixed && (i == 0 || i == n - 1); };
  for (int i = 0; i < n; ++i) {
    for (int j = std::max(0, i - 1); j <= std::min(n - 1, i + 1); ++j) {
      double value = i != j ? -1 : (i == 0 || i == n - 1 ? 1 : 2);
      value *= stiffness;
      if (drop_columns && is_fixed(j)) value = 0;
      if (is_fixed(i)) value = i == j ? 1 : 0;
      matrix[i * n + j] = value;
    }
  }
  return matrix;
}

}  // namespace

TEST_CASE("cells add up to the chain's matrix, as often as wanted") {
  const Chain chain;
  AssembledMatrix matrix(chain.layout, chain.rows, 2, {});
  for (const double stiffness : {1.0, 3.0}) {
    std::vector<double> values = chain.springs;
    for (double& value : values) value *= stiffness;
    matrix.assemble(values);
    CHECK(dense(matrix.get(), chain.num_points) == expected(chain.num_points, false, false, stiffness));
  }
}

TEST_CASE("constrained rows are those of the identity, columns too if wanted") {
  const Chain chain;
  for (const bool drop_columns : {false, true}) {
    AssembledMatrix matrix(chain.layout, chain.rows, 2, chain.ends(), drop_columns);
    matrix.assemble(chain.springs);
    matrix.assemble(chain.springs);
    CHECK(dense(matrix.get(), chain.num_points) == expected(chain.num_points, true, drop_columns, 1));
  }
}

TEST_CASE("a constraint is known on every rank that sees its row") {
  const Chain chain;
  // Constrain the last owned point of each rank: the next rank sees it as a ghost.
  const std::vector<PetscInt> last = {chain.layout.num_owned() - 1};
  std::vector<PetscInt> rows = chain.rows;
  rows.push_back(-1);
  const auto marks = is_constrained(chain.layout, rows, last);
  const int here = base::rank(MPI_COMM_WORLD);
  CHECK(marks == std::vector<char>{static_cast<char>(here > 0), 0, 0, 0, 0, 1, 0});
}

TEST_CASE("an unknown left out of a cell leaves no entry") {
  const Chain chain;
  std::vector<PetscInt> rows = chain.rows;
  // The last point of all has no unknown: its row is empty but for what the constraint puts there.
  for (PetscInt& row : rows) {
    if (row == chain.num_points - 1) row = -1;
  }
  AssembledMatrix matrix(chain.layout, rows, 2, {});
  matrix.assemble(chain.springs);
  const auto found = dense(matrix.get(), chain.num_points);
  CHECK(found.back() == 0);
  CHECK(found.front() == 1);
}
