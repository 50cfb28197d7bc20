#include "coupling/balance.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"
#include "tests/coupling/small_scene.hpp"

using namespace vocalis;
using namespace vocalis::coupling;
using Catch::Matchers::Contains;

namespace {

/// A strip of cells: the first third is solid, the second fluid, the last air, or another order of these.
mesh::WholeMesh strip_of_thirds() {
  mesh::WholeMesh whole = mesh::box(MPI_COMM_SELF, {3, 1, 0}, {60, 20, 0});
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    double centre = 0;
    for (int i = 0; i < 3; ++i) centre += whole.coordinates[whole.cell_vertices[3 * cell + i] * 2] / 3;
    whole.cell_region[cell] = static_cast<std::int32_t>(centre);
  }
  return whole;
}

/// Largest over mean of one kind of work, less 1.
double imbalance(const CellWork& work, int kind, const std::vector<std::int32_t>& cell_rank, int ranks) {
  std::vector<double> sums(ranks, 0);
  double total = 0;
  for (std::size_t cell = 0; cell < cell_rank.size(); ++cell) {
    sums[cell_rank[cell]] += work.units[cell * work.solvers + kind];
    total += work.units[cell * work.solvers + kind];
  }
  return *std::max_element(sums.begin(), sums.end()) * ranks / total - 1;
}

}  // namespace

TEST_CASE("a cell is work for the solvers that its region takes part in", "[serial]") {
  const mesh::WholeMesh whole = strip_of_thirds();
  const std::vector<RegionKind> kinds = {RegionKind::solid, RegionKind::fluid, RegionKind::air};
  const CellWork both = work_of_cells(whole, kinds, true, true);
  REQUIRE(both.solvers == 2);
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    CHECK(both.units[2 * cell] == (whole.cell_region[cell] < 2));
    CHECK(both.units[2 * cell + 1] == (whole.cell_region[cell] > 0));
  }
  const CellWork sound = work_of_cells(whole, kinds, false, true);
  CHECK(sound.solvers == 1);
  CHECK(sound.units.size() == static_cast<std::size_t>(whole.num_cells()));
}

TEST_CASE("with a constraint for each solver both are balanced within a tenth, though their cells differ", "[serial]") {
  const mesh::WholeMesh whole = strip_of_thirds();
  const CellWork work = work_of_cells(whole, {RegionKind::solid, RegionKind::fluid, RegionKind::air}, true, true);
  for (const int ranks : {2, 4, 8}) {
    const auto cell_rank = mesh::partition_cells(whole, ranks, work.units, work.solvers);
    CHECK(imbalance(work, 0, cell_rank, ranks) < 0.1);
    CHECK(imbalance(work, 1, cell_rank, ranks) < 0.1);
  }
}

TEST_CASE("the balance of a mesh is that of the cells that ranks own") {
  const auto scene = test::box_scene(
      {2, 1, 0}, {8, 4, 0}, [](const auto& centre) { return centre[0] < 1 ? RegionKind::fluid : RegionKind::air; });
  const Balance found = balance(scene->flow->mesh);
  const auto mine = static_cast<double>(scene->flow->mesh.cells.num_owned);
  CHECK(found.cells == 32);
  CHECK(found.ranks == base::size(MPI_COMM_WORLD));
  CHECK(found.imbalance() == Approx(base::largest(MPI_COMM_WORLD, mine) * found.ranks / 32 - 1).margin(1e-14));
  CHECK(found.idle_ranks == base::sum(MPI_COMM_WORLD, static_cast<int>(mine == 0)));
}

TEST_CASE("ranks that would idle are told of, with a number of ranks that would not", "[serial]") {
  CHECK(advice("the flow", {.cells = 1000, .largest_share = 270, .ranks = 4, .idle_ranks = 0}).empty());
  CHECK(advice("the flow", {.cells = 5, .largest_share = 5, .ranks = 1, .idle_ranks = 0}).empty());
  CHECK_THAT(advice("the flow", {.cells = 120, .largest_share = 60, .ranks = 4, .idle_ranks = 2}),
             Contains("2 of 4 ranks have no cell of the flow, which has 120: at most 2 would be of use"));
  CHECK_THAT(advice("sound", {.cells = 1000, .largest_share = 300, .ranks = 4, .idle_ranks = 0}),
             Contains("sound: one rank has 20 % more cells than the mean") && Contains("try another number"));
}
