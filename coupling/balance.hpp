#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "core/mesh/partition.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

/// Which solver a region's cells take part in.
inline bool carries_flow(RegionKind kind) { return kind != RegionKind::air; }
inline bool carries_sound(RegionKind kind) { return kind != RegionKind::solid; }

/// Kind of each region by its name; air where the case does not name it.
std::vector<RegionKind> kinds_of_regions(const Case& config, const std::vector<std::string>& names);

/// How much each cell is for each solver that the case has, flow before sound: one unit where it takes part.
struct CellWork {
  int solvers = 0;
  std::vector<std::int32_t> units;  ///< (cells, solvers)
};
CellWork work_of_cells(const mesh::WholeMesh& whole, const std::vector<RegionKind>& kinds, bool has_flow,
                       bool has_sound);

/// How a solver's cells are shared out.
struct Balance {
  std::int64_t cells = 0;          ///< of all ranks
  std::int64_t largest_share = 0;  ///< cells of the rank that has most
  int ranks = 1;
  int idle_ranks = 0;  ///< without a cell

  /// Largest over mean of the cells that ranks own, less 1: what the others wait, as a part of their own work.
  double imbalance() const;
};

/// Of the cells that ranks own. Collective.
Balance balance(const mesh::Mesh& mesh);

/// A sentence for who is about to pay for idle ranks, and what to do; empty if nothing is amiss: every rank has cells,
/// and none has a tenth more than the mean.
std::string advice(const std::string& solver, const Balance& balance);

}  // namespace vocalis::coupling
