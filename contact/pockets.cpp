#include "contact/pockets.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"

namespace vocalis::contact {

namespace {

enum Kind : std::int32_t { barrier, narrow, reached };

/// Reaches all narrow owned cells that a way leads to from the given reached cells.
void walk(const mesh::Mesh& mesh, std::vector<std::int32_t> from, std::vector<std::int32_t>& kind) {
  const int facets = mesh.dimension + 1;
  while (!from.empty()) {
    const std::int32_t cell = from.back();
    from.pop_back();
    for (int i = 0; i < facets; ++i) {
      const std::int32_t next = mesh.cell_neighbours[static_cast<std::size_t>(cell) * facets + i];
      if (next < 0 || next >= mesh.num_cells() || kind[next] != narrow) continue;
      kind[next] = reached;
      from.push_back(next);
    }
  }
}

/// Narrow owned cells beside a reached ghost, which become reached.
std::vector<std::int32_t> step_over(const mesh::Mesh& mesh, std::vector<std::int32_t>& kind) {
  const int facets = mesh.dimension + 1;
  std::vector<std::int32_t> entered;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (kind[cell] != narrow) continue;
    for (int i = 0; i < facets && kind[cell] == narrow; ++i) {
      const std::int32_t next = mesh.cell_neighbours[static_cast<std::size_t>(cell) * facets + i];
      if (next >= mesh.num_cells() && kind[next] == reached) kind[cell] = reached;
    }
    if (kind[cell] == reached) entered.push_back(cell);
  }
  return entered;
}

}  // namespace

std::vector<char> find_pockets(const WallDistance& walls, std::span<const double> width,
                               std::span<const char> in_contact) {
  const fem::Space& space = *walls.distance.space;
  const mesh::Mesh& mesh = *space.mesh;
  std::vector<std::int32_t> kind(mesh.cells.num_local(), barrier), from;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0 || in_contact[cell]) continue;
    const bool is_narrow = std::all_of(dofs.begin(), dofs.end(),
                                       [&](std::int32_t dof) { return walls.distance.values[dof] <= width[cell]; });
    kind[cell] = is_narrow ? narrow : reached;
    if (!is_narrow) from.push_back(cell);
  }
  do {
    walk(mesh, std::move(from), kind);
    mesh.cell_halo.copy_to_ghosts(kind);
    from = step_over(mesh, kind);
  } while (base::largest(mesh.comm, static_cast<std::int32_t>(!from.empty())) > 0);
  std::vector<char> pockets(mesh.num_cells());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) pockets[cell] = kind[cell] == narrow;
  return pockets;
}

}  // namespace vocalis::contact
