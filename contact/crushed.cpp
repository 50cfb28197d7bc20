#include "contact/crushed.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "contact/contact_corners.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::contact {

namespace {

/// d! measure / longest edge^d.
template <int D>
double thickness(const mesh::Mesh& mesh, std::int32_t cell, std::span<const double> coordinates) {
  std::array<const double*, D + 1> corners;
  for (int i = 0; i <= D; ++i) {
    corners[i] = coordinates.data() + static_cast<std::size_t>(mesh.vertices_of(cell)[i]) * D;
  }
  double longest = 0;  // squared
  for (int i = 0; i <= D; ++i) {
    for (int j = 0; j < i; ++j) {
      double square = 0;
      for (int k = 0; k < D; ++k) square += (corners[i][k] - corners[j][k]) * (corners[i][k] - corners[j][k]);
      longest = std::max(longest, square);
    }
  }
  return (D == 2 ? 2 : 6) * fem::simplex_geometry<D>(corners).measure / std::pow(longest, 0.5 * D);
}

}  // namespace

std::vector<char> find_crushed(const WallDistance& walls, std::span<const double> width,
                               std::span<const double> coordinates, std::span<const char> in_contact, double thinnest) {
  const fem::Space& space = *walls.distance.space;
  const mesh::Mesh& mesh = *space.mesh;
  const std::vector<std::int32_t> is_corner = contact_corners(space, in_contact);
  std::vector<char> crushed(mesh.num_cells(), 0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0 || in_contact[cell]) continue;
    const bool touches = std::any_of(dofs.begin(), dofs.end(), [&](std::int32_t dof) { return is_corner[dof] != 0; });
    const bool is_narrow = std::all_of(dofs.begin(), dofs.end(),
                                       [&](std::int32_t dof) { return walls.distance.values[dof] <= width[cell]; });
    if (!touches || !is_narrow) continue;
    crushed[cell] = (mesh.dimension == 2 ? thickness<2>(mesh, cell, coordinates)
                                         : thickness<3>(mesh, cell, coordinates)) < thinnest;
  }
  return crushed;
}

}  // namespace vocalis::contact
