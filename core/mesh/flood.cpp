#include "core/mesh/flood.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::mesh {

std::vector<std::int32_t> flooded(const Mesh& mesh, std::span<const std::int32_t> from,
                                  std::span<const char> is_barred) {
  const auto place_of = [&mesh](std::int32_t cell, int facet) {
    return static_cast<std::size_t>(cell) * (mesh.dimension + 1) + facet;
  };
  std::vector<std::int32_t> marks(mesh.cells.num_local(), 0);
  std::copy(from.begin(), from.end(), marks.begin());
  std::int32_t changed = 1;
  while (base::largest(mesh.comm, changed) > 0) {
    mesh.cell_halo.copy_to_ghosts(marks);
    changed = 0;
    std::vector<std::int32_t> waiting;
    const auto is_reached = [&](std::int32_t cell) {
      for (int i = 0; i <= mesh.dimension; ++i) {
        const std::int32_t behind = mesh.cell_neighbours[place_of(cell, i)];
        if (behind >= 0 && marks[behind] && !is_barred[place_of(cell, i)]) return true;
      }
      return false;
    };
    for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
      if (!marks[cell] && is_reached(cell)) waiting.push_back(cell);
    }
    while (!waiting.empty()) {
      const std::int32_t cell = waiting.back();
      waiting.pop_back();
      if (marks[cell]) continue;
      marks[cell] = changed = 1;
      for (int i = 0; i <= mesh.dimension; ++i) {
        const std::int32_t behind = mesh.cell_neighbours[place_of(cell, i)];
        const bool goes = behind >= 0 && behind < mesh.num_cells() && !is_barred[place_of(cell, i)];
        if (goes && !marks[behind]) waiting.push_back(behind);
      }
    }
  }
  return marks;
}

}  // namespace vocalis::mesh
