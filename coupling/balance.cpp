#include "coupling/balance.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::coupling {

namespace {

constexpr double tolerable = 0.1;                   // imbalance of which nobody is warned
constexpr std::int64_t fewest_cells_for_rank = 50;  // below this METIS cannot share them out evenly

}  // namespace

std::vector<RegionKind> kinds_of_regions(const Case& config, const std::vector<std::string>& names) {
  std::vector<RegionKind> kinds(names.size(), RegionKind::air);
  for (const coupling::Region& region : config.regions) kinds[mesh::index_of(names, region.name)] = region.kind;
  return kinds;
}

CellWork work_of_cells(const mesh::WholeMesh& whole, const std::vector<RegionKind>& kinds, bool has_flow,
                       bool has_sound) {
  CellWork work;
  work.solvers = static_cast<int>(has_flow) + static_cast<int>(has_sound);
  for (const std::int32_t region : whole.cell_region) {
    if (has_flow) work.units.push_back(carries_flow(kinds[region]));
    if (has_sound) work.units.push_back(carries_sound(kinds[region]));
  }
  return work;
}

double Balance::imbalance() const {
  return cells > 0 ? static_cast<double>(largest_share) * ranks / static_cast<double>(cells) - 1 : 0;
}

Balance balance(const mesh::Mesh& mesh) {
  const std::vector<std::int64_t> shares = base::gather_all(mesh.comm, static_cast<std::int64_t>(mesh.cells.num_owned));
  return {.cells = mesh.cells.num_global,
          .largest_share = *std::max_element(shares.begin(), shares.end()),
          .ranks = static_cast<int>(shares.size()),
          .idle_ranks = static_cast<int>(std::count(shares.begin(), shares.end(), 0))};
}

std::string advice(const std::string& solver, const Balance& balance) {
  if (balance.ranks == 1 || balance.cells == 0) return "";
  const std::int64_t useful = std::max<std::int64_t>(1, balance.cells / fewest_cells_for_rank);
  if (balance.idle_ranks > 0) {
    return fmt::format("{} of {} ranks have no cell of {}, which has {}: at most {} would be of use",
                       balance.idle_ranks, balance.ranks, solver, balance.cells, useful);
  }
  if (balance.imbalance() <= tolerable) return "";
  const bool too_many = balance.ranks > useful;
  return fmt::format(
      "{}: one rank has {:.0f} % more cells than the mean, and the others wait for it; {}", solver,
      100 * balance.imbalance(),
      too_many ? fmt::format("at most {} ranks would be of use", useful) : "try another number of ranks");
}

}  // namespace vocalis::coupling
