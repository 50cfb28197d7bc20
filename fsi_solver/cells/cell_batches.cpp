#include "fsi_solver/cells/cell_batches.hpp"

#include <algorithm>

namespace vocalis::fsi {

CellBatches make_batches(const std::vector<std::int32_t>& cells, const std::vector<std::int32_t>& cell_solid,
                         const fem::Space& velocities, const fem::Space& pressures) {
  std::vector<std::int32_t> sorted = cells;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](std::int32_t a, std::int32_t b) { return cell_solid[a] < cell_solid[b]; });
  CellBatches result;
  result.nodes = velocities.dofs_per_cell;
  result.corners = pressures.dofs_per_cell;
  for (std::size_t i = 0; i < sorted.size();) {
    CellBatches::Batch batch;
    batch.solid = cell_solid[sorted[i]];
    for (; i < sorted.size() && batch.active < lane_count && cell_solid[sorted[i]] == batch.solid; ++i) {
      batch.cell[batch.active++] = sorted[i];
    }
    for (int lane = batch.active; lane < lane_count; ++lane) batch.cell[lane] = batch.cell[0];
    result.batches.push_back(batch);
    const auto append = [&batch](std::vector<std::int32_t>& list, int count, const auto& dofs_of) {
      for (int a = 0; a < count; ++a) {
        for (const std::int32_t cell : batch.cell) list.push_back(dofs_of(cell)[a]);
      }
    };
    append(result.velocity_dofs, result.nodes, [&](std::int32_t cell) { return velocities.dofs_of(cell); });
    append(result.pressure_dofs, result.corners, [&](std::int32_t cell) { return pressures.dofs_of(cell); });
    append(result.vertices, result.corners, [&](std::int32_t cell) { return velocities.mesh->vertices_of(cell); });
  }
  return result;
}

}  // namespace vocalis::fsi
