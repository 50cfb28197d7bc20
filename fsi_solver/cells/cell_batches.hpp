#pragma once

#include <cstdint>
#include <vector>

#include "core/fem/space.hpp"
#include "fsi_solver/cells/lanes.hpp"

namespace vocalis::fsi {

/// The owned cells of a mesh in batches that are computed side by side; the cells of a batch are of one kind.
struct CellBatches {
  struct Batch {
    std::int32_t solid = -1;             ///< index of the solid, -1: fluid
    int active = 0;                      ///< lanes that count; the rest repeat the first cell
    std::int32_t cell[lane_count] = {};  ///< of each lane
  };
  int nodes = 0, corners = 0;
  std::vector<Batch> batches;
  std::vector<std::int32_t> velocity_dofs;  ///< (batches, nodes, lanes)
  std::vector<std::int32_t> pressure_dofs;  ///< (batches, corners, lanes), -1 without a pressure
  std::vector<std::int32_t> vertices;       ///< (batches, corners, lanes)

  const std::int32_t* velocity_dofs_of(std::size_t batch) const {
    return velocity_dofs.data() + batch * nodes * lane_count;
  }
  const std::int32_t* pressure_dofs_of(std::size_t batch) const {
    return pressure_dofs.data() + batch * corners * lane_count;
  }
  const std::int32_t* vertices_of(std::size_t batch) const { return vertices.data() + batch * corners * lane_count; }
};

/// Of the given cells.
///
/// cell_solid  (owned cells) index of the solid, -1: fluid
CellBatches make_batches(const std::vector<std::int32_t>& cells, const std::vector<std::int32_t>& cell_solid,
                         const fem::Space& velocities, const fem::Space& pressures);

}  // namespace vocalis::fsi
