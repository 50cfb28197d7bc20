#include "contact/medial_axis.hpp"

namespace vocalis::contact {

std::vector<char> medial_axis(const WallDistance& walls, double gamma) {
  const fem::Space& space = *walls.distance.space;
  const int d = space.mesh->dimension;
  const auto mean_is_short = [&](std::int32_t a, std::int32_t b) {
    double square = 0;
    for (int k = 0; k < d; ++k) {
      const double mean = 0.5 * (walls.direction[static_cast<std::size_t>(a) * d + k] +
                                 walls.direction[static_cast<std::size_t>(b) * d + k]);
      square += mean * mean;
    }
    return square <= gamma * gamma;
  };
  const auto is_near = [&](std::int32_t dof) { return walls.distance.values[dof] < walls.bound; };
  std::vector<char> on_axis(space.mesh->num_cells(), 0);
  for (std::int32_t cell = 0; cell < space.mesh->num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0) continue;
    for (int i = 0; i <= d; ++i) {
      for (int j = 0; j <= i; ++j) {
        on_axis[cell] |= static_cast<char>(is_near(dofs[i]) && is_near(dofs[j]) && mean_is_short(dofs[i], dofs[j]));
      }
    }
  }
  return on_axis;
}

}  // namespace vocalis::contact
