#include "contact/slivers.hpp"

#include <algorithm>

namespace vocalis::contact {

std::vector<char> find_slivers(const WallDistance& walls, std::span<const char> in_contact) {
  const fem::Space& space = *walls.distance.space;
  const std::int32_t cells = space.mesh->num_cells();
  std::vector<std::int32_t> is_held(space.num_dofs(), 0);  // by contact cells
  for (std::int32_t cell = 0; cell < cells; ++cell) {
    if (!in_contact[cell]) continue;
    for (const std::int32_t dof : space.dofs_of(cell)) is_held[dof] = 1;
  }
  space.halo.max_to_owners(is_held);
  space.halo.copy_to_ghosts(is_held);
  std::vector<char> slivers(cells, 0);
  for (std::int32_t cell = 0; cell < cells; ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0 || in_contact[cell]) continue;
    const auto is_on_wall = [&](std::int32_t dof) { return walls.distance.values[dof] == 0; };
    slivers[cell] = !std::all_of(dofs.begin(), dofs.end(), is_on_wall) &&
                    std::all_of(dofs.begin(), dofs.end(), [&](auto dof) { return is_held[dof] || is_on_wall(dof); });
  }
  return slivers;
}

}  // namespace vocalis::contact
