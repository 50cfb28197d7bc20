#include "contact/contact_corners.hpp"

namespace vocalis::contact {

std::vector<std::int32_t> contact_corners(const fem::Space& space, std::span<const char> in_contact) {
  std::vector<std::int32_t> is_corner(space.num_dofs(), 0);
  for (std::int32_t cell = 0; cell < space.mesh->num_cells(); ++cell) {
    if (!in_contact[cell]) continue;
    for (const std::int32_t dof : space.dofs_of(cell)) is_corner[dof] = 1;
  }
  space.halo.max_to_owners(is_corner);
  space.halo.copy_to_ghosts(is_corner);
  return is_corner;
}

}  // namespace vocalis::contact
