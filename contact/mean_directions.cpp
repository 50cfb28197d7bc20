#include "contact/mean_directions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/fem/simplex.hpp"

namespace vocalis::contact {

namespace {

bool is_zero(const double* vector, int dimension) {
  return std::all_of(vector, vector + dimension, [](double value) { return value == 0; });
}

template <int D>
fem::SimplexGeometry<D> geometry_of(const fem::Space& space, std::int32_t cell, std::span<const double> coordinates) {
  std::array<const double*, D + 1> corners;
  for (int i = 0; i <= D; ++i) {
    corners[i] = coordinates.data() + static_cast<std::size_t>(space.mesh->vertices_of(cell)[i]) * D;
  }
  return fem::simplex_geometry<D>(corners);
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
    const auto geometry = geometry_of<D>(space, cell, coordinates);
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

}  // namespace

void take_mean_on_planes(const fem::Field& distance, std::span<const double> coordinates,
                         std::span<const SymmetryPlane> planes, std::vector<double>& directions) {
  const fem::Space& space = *distance.space;
  const int d = space.mesh->dimension;
  for (const SymmetryPlane& plane : planes) {
    const std::vector<char> on_plane = vertices_on_plane(*space.mesh, coordinates, plane);
    for (std::int32_t dof = 0; dof < space.dofs.num_owned; ++dof) {
      if (!on_plane[space.dof_vertex[dof]]) continue;
      double* direction = directions.data() + static_cast<std::size_t>(dof) * d;
      const double across = std::exchange(direction[plane.axis], 0.0);
      if (distance.values[dof] > 0) continue;
      const double length = std::sqrt(std::inner_product(direction, direction + d, direction, 0.0));
      const bool lies_in_plane = length <= 1e-9;
      if (lies_in_plane) direction[plane.axis] = across;
      for (int k = 0; k < d && !lies_in_plane; ++k) direction[k] /= length;
    }
  }
  space.halo.copy_to_ghosts(directions, d);
}

std::vector<double> mean_directions(const fem::Field& distance, std::vector<double> normals,
                                    std::span<const double> coordinates, std::span<const SymmetryPlane> planes) {
  distance.space->mesh->dimension == 2 ? add_mean_directions<2>(distance, coordinates, normals)
                                       : add_mean_directions<3>(distance, coordinates, normals);
  take_mean_on_planes(distance, coordinates, planes, normals);
  return normals;
}

std::vector<double> smoothness(const fem::Space& space, std::span<const double> coordinates,
                               std::span<const double> direction) {
  const int d = space.mesh->dimension;
  std::vector<double> sums(2 * static_cast<std::size_t>(space.num_dofs()), 0.0);  // measure x agreement, measure
  for (std::int32_t cell = 0; cell < space.mesh->num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0) continue;
    std::array<double, 3> mean = {0, 0, 0};
    for (const std::int32_t dof : dofs) {
      for (int k = 0; k < d; ++k) mean[k] += direction[static_cast<std::size_t>(dof) * d + k] / (d + 1);
    }
    const double agreement = std::clamp((std::hypot(mean[0], mean[1], mean[2]) - 0.5) / (0.9 - 0.5), 0.0, 1.0);
    const double measure =
        d == 2 ? geometry_of<2>(space, cell, coordinates).measure : geometry_of<3>(space, cell, coordinates).measure;
    for (const std::int32_t dof : dofs) {
      sums[2 * static_cast<std::size_t>(dof)] += measure * agreement;
      sums[2 * static_cast<std::size_t>(dof) + 1] += measure;
    }
  }
  space.halo.add_to_owners(sums, 2);
  space.halo.copy_to_ghosts(sums, 2);
  std::vector<double> result(space.num_dofs());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = sums[2 * i] / sums[2 * i + 1];
  return result;
}

}  // namespace vocalis::contact
