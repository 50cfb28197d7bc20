#include "contact/wall_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "contact/nearest_facet.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::contact {

namespace {

bool is_zero(const double* vector, int dimension) {
  return std::all_of(vector, vector + dimension, [](double value) { return value == 0; });
}

/// Means of the directions of ∇D over the cells around each dof i from which the distance comes, weighted by their
/// measure times (∇D·∇λ_i)^+, at the dofs where `direction` is still 0. A mean over all cells would be short one cell
/// too early, and one of ∇D itself, which viscosity shortens, short in the corners of walls.
template <int D>
void add_mean_directions(const fem::Field& distance, std::span<const double> coordinates,
                         std::vector<double>& direction) {
  const fem::Space& space = *distance.space;
  const mesh::Mesh& mesh = *space.mesh;
  std::vector<double> sums(static_cast<std::size_t>(space.num_dofs()) * (D + 1), 0.0);  // weight x direction, weight
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0) continue;
    std::array<const double*, D + 1> corners;
    for (int i = 0; i <= D; ++i) {
      corners[i] = coordinates.data() + static_cast<std::size_t>(mesh.vertices_of(cell)[i]) * D;
    }
    const auto geometry = fem::simplex_geometry<D>(corners);
    std::array<double, D> slope = {};
    for (int i = 0; i <= D; ++i) {
      for (int k = 0; k < D; ++k) slope[k] += distance.values[dofs[i]] * geometry.gradient[i][k];
    }
    const double length = std::sqrt(std::inner_product(slope.begin(), slope.end(), slope.begin(), 0.0));
    for (int i = 0; i <= D && length > 0; ++i) {
      const auto& gradient = geometry.gradient[i];
      const double growth = std::inner_product(slope.begin(), slope.end(), gradient.begin(), 0.0);
      const double weight = geometry.measure * std::max(growth, 0.0);
      double* sum = sums.data() + static_cast<std::size_t>(dofs[i]) * (D + 1);
      for (int k = 0; k < D; ++k) sum[k] += weight * slope[k] / length;
      sum[D] += weight;
    }
  }
  space.halo.add_to_owners(sums, D + 1);
  space.halo.copy_to_ghosts(sums, D + 1);
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    double* here = direction.data() + static_cast<std::size_t>(dof) * D;
    const double* sum = sums.data() + static_cast<std::size_t>(dof) * (D + 1);
    if (!is_zero(here, D) || sum[D] == 0) continue;
    for (int k = 0; k < D; ++k) here[k] = sum[k] / sum[D];
  }
}

/// Leaves the directions on each plane no component across it. On a wall the mean is scaled to length one, as normals
/// are; a wall that lies in the plane keeps its own. Owners first; on return ghosts are current. Collective.
void take_mean_on_planes(std::span<const double> coordinates, std::span<const SymmetryPlane> planes,
                         WallDistance& walls) {
  const fem::Space& space = *walls.distance.space;
  const int d = space.mesh->dimension;
  for (const SymmetryPlane& plane : planes) {
    const std::vector<char> on_plane = vertices_on_plane(*space.mesh, coordinates, plane);
    for (std::int32_t dof = 0; dof < space.dofs.num_owned; ++dof) {
      if (!on_plane[space.dof_vertex[dof]]) continue;
      double* direction = walls.direction.data() + static_cast<std::size_t>(dof) * d;
      const double across = std::exchange(direction[plane.axis], 0.0);
      if (walls.distance.values[dof] > 0) continue;
      const double length = std::sqrt(std::inner_product(direction, direction + d, direction, 0.0));
      const bool lies_in_plane = length <= 1e-9;
      if (lies_in_plane) direction[plane.axis] = across;
      for (int k = 0; k < d && !lies_in_plane; ++k) direction[k] /= length;
    }
  }
  space.halo.copy_to_ghosts(walls.direction, d);
}

}  // namespace

WallDistance direct_distance(const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                             std::span<const double> coordinates, std::span<const SymmetryPlane> planes, double bound) {
  const int d = space.mesh->dimension;
  const Walls walls = gather_walls(*space.mesh, facets, coordinates, planes);
  const NearestFacet tree(walls);
  WallDistance result{fem::Field(space, 1), wall_normals(space, facets, coordinates), bound};
  for (std::int32_t dof = 0; dof < space.dofs.num_owned; ++dof) {
    double* direction = result.direction.data() + static_cast<std::size_t>(dof) * d;
    if (!is_zero(direction, d)) continue;
    const double* point = coordinates.data() + static_cast<std::size_t>(space.dof_vertex[dof]) * d;
    const Nearest nearest = tree.find(point, bound);
    result.distance.values[dof] = std::min(nearest.distance, bound);
    if (nearest.facet < 0 || nearest.distance == 0) continue;
    for (int k = 0; k < d; ++k) direction[k] = (point[k] - nearest.point[k]) / nearest.distance;
  }
  result.distance.copy_to_ghosts();
  take_mean_on_planes(coordinates, planes, result);
  return result;
}

WallDistance eikonal_distance(Eikonal& eikonal, const fem::Space& space, std::span<const mesh::NamedFacet> facets,
                              std::span<const double> coordinates, std::span<const SymmetryPlane> planes,
                              const EikonalSettings& settings, std::span<const double> guess, EikonalReport& report) {
  const int d = space.mesh->dimension;
  WallDistance result{fem::Field(space, 1), wall_normals(space, facets, coordinates)};
  std::copy(guess.begin(), guess.end(), result.distance.values.begin());
  std::vector<char> on_wall(space.num_dofs());
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    on_wall[dof] = !is_zero(result.direction.data() + static_cast<std::size_t>(dof) * d, d);
  }
  report = eikonal.solve(coordinates, on_wall, planes, settings, result.distance);
  d == 2 ? add_mean_directions<2>(result.distance, coordinates, result.direction)
         : add_mean_directions<3>(result.distance, coordinates, result.direction);
  take_mean_on_planes(coordinates, planes, result);
  return result;
}

}  // namespace vocalis::contact
