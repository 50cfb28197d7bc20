#include "contact/slivers.hpp"

#include <algorithm>

#include "contact/contact_corners.hpp"

namespace vocalis::contact {

std::vector<char> find_slivers(const WallDistance& walls, std::span<const char> in_contact) {
  const fem::Space& space = *walls.distance.space;
  const std::int32_t cells = space.mesh->num_cells();
  const std::vector<std::int32_t> is_held = contact_corners(space, in_contact);
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
