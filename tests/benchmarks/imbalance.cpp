// How evenly METIS shares out the cells of a case with one constraint (all work of a cell together) and with one for
// each solver: largest over mean of the cells of a rank, less 1, facets cut between ranks, and METIS's own seconds. On
// one rank; nothing is solved.
//   benchmark_imbalance CASE.toml [ranks...]
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <map>

#include "core/base/session.hpp"
#include "core/base/stopwatch.hpp"
#include "core/io/gmsh_reader.hpp"
#include "core/mesh/partition.hpp"
#include "coupling/balance.hpp"

namespace vocalis::coupling {
namespace {

/// Imbalance of each kind of work.
std::vector<double> imbalances(const CellWork& work, const std::vector<std::int32_t>& cell_rank, int ranks) {
  std::vector<double> result;
  for (int kind = 0; kind < work.solvers; ++kind) {
    std::vector<double> sums(ranks, 0);
    double total = 0;
    for (std::size_t cell = 0; cell < cell_rank.size(); ++cell) {
      const double units = work.units[cell * work.solvers + kind];
      sums[cell_rank[cell]] += units;
      total += units;
    }
    result.push_back(*std::max_element(sums.begin(), sums.end()) * ranks / total - 1);
  }
  return result;
}

CellWork together(const CellWork& work) {
  CellWork result = {.solvers = 1, .units = {}};
  for (std::size_t i = 0; i < work.units.size(); i += work.solvers) {
    result.units.push_back(0);
    for (int kind = 0; kind < work.solvers; ++kind) result.units.back() += work.units[i + kind];
  }
  return result;
}

/// Facets between cells of different ranks.
long cut_facets(const mesh::WholeMesh& whole, const std::vector<std::int32_t>& cell_rank) {
  const int corners = whole.dimension + 1;
  std::map<std::vector<std::int64_t>, std::int32_t> rank_of_facet;
  long cut = 0;
  for (std::int64_t cell = 0; cell < whole.num_cells(); ++cell) {
    for (int i = 0; i < corners; ++i) {
      const auto first = whole.cell_vertices.begin() + cell * corners;
      std::vector<std::int64_t> facet(first, first + corners);
      facet.erase(facet.begin() + i);
      std::sort(facet.begin(), facet.end());
      const auto [entry, is_new] = rank_of_facet.try_emplace(facet, cell_rank[cell]);
      if (!is_new && entry->second != cell_rank[cell]) ++cut;
    }
  }
  return cut;
}

void measure(const Case& config, const std::vector<int>& all_ranks) {
  const bool curved = config.flow && config.flow->elements == fsi::Elements::p2p1;
  const mesh::WholeMesh whole = config.mesh.is_geometry
                                    ? io::mesh_geometry(MPI_COMM_SELF, config.mesh.file, config.mesh.parameters, curved)
                                    : io::read_mesh(MPI_COMM_SELF, config.mesh.file, curved);
  const CellWork work = work_of_cells(whole, kinds_of_regions(config, whole.region_names), config.flow.has_value(),
                                      !config.acoustics.empty());
  fmt::print("| ranks | constraints | {}{}cut facets | METIS [s] |\n| --- | --- | {}--- | --- |\n",
             config.flow ? "flow | " : "", config.acoustics.empty() ? "" : "acoustic | ",
             work.solvers == 2 ? "--- | --- | " : "--- | ");
  for (const int ranks : all_ranks) {
    std::vector<CellWork> ways = {together(work)};
    if (work.solvers > 1) ways.push_back(work);
    for (const CellWork& weights : ways) {
      const base::Stopwatch watch;
      const auto cell_rank = mesh::partition_cells(whole, ranks, weights.units, weights.solvers);
      const double seconds = watch.seconds();
      fmt::print("| {} | {} | ", ranks, weights.solvers);
      for (const double imbalance : imbalances(work, cell_rank, ranks)) fmt::print("{:.1f} % | ", 100 * imbalance);
      fmt::print("{} | {:.3g} |\n", cut_facets(whole, cell_rank), seconds);
    }
  }
}

}  // namespace
}  // namespace vocalis::coupling

int main(int argc, char** argv) {
  const vocalis::base::Session session(argc, argv);
  if (argc < 2) return 2;
  std::vector<int> ranks;
  for (int i = 2; i < argc; ++i) ranks.push_back(std::atoi(argv[i]));
  if (ranks.empty()) ranks = {2, 4, 8};
  vocalis::coupling::measure(vocalis::coupling::read_case(MPI_COMM_SELF, argv[1], {}), ranks);
}
