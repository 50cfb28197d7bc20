#include "contact/axis_gap.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vocalis::contact {

namespace {

using Vector = std::array<double, 3>;

struct Corner {
  const double* point;
  const double* direction;
  double distance;
};

double length(const Vector& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/// Half the sum, or half the difference, of the directions of two corners.
Vector half(const Corner& a, const Corner& b, double sign, int dimension) {
  Vector result = {0, 0, 0};
  for (int k = 0; k < dimension; ++k) result[k] = 0.5 * (a.direction[k] + sign * b.direction[k]);
  return result;
}

/// The gap between the walls of two corners; sets the normal if it is narrower than `narrowest`.
double gap_of_pair(const Corner& a, const Corner& b, int dimension, double narrowest, double* normal) {
  const Vector across = half(a, b, -1, dimension);
  const double size = length(across);
  double between = 0;
  for (int k = 0; k < dimension && size > 0; ++k) between += across[k] / size * (a.point[k] - b.point[k]);
  const double gap = a.distance + b.distance + std::abs(between);
  if (gap >= narrowest) return narrowest;
  for (int k = 0; k < dimension && size > 0; ++k) normal[k] = across[k] / size;
  return gap;
}

/// The direction of the corner with the longest one, for cells at a plane of symmetry.
void take_steepest(std::span<const Corner> corners, int dimension, double* normal) {
  double longest = 0;
  for (const Corner& corner : corners) {
    const double size = length(half(corner, corner, 1, dimension));
    if (size <= longest) continue;
    longest = size;
    for (int k = 0; k < dimension; ++k) normal[k] = corner.direction[k] / size;
  }
}

}  // namespace

AxisGap axis_gap(const WallDistance& walls, std::span<const double> coordinates, double gamma) {
  const fem::Space& space = *walls.distance.space;
  const mesh::Mesh& mesh = *space.mesh;
  const int d = mesh.dimension;
  AxisGap result;
  result.gap.assign(mesh.num_cells(), std::numeric_limits<double>::infinity());
  result.normal.assign(static_cast<std::size_t>(mesh.num_cells()) * d, 0.0);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = space.dofs_of(cell);
    if (dofs[0] < 0) continue;
    std::array<Corner, 4> corners;
    for (int i = 0; i <= d; ++i) {
      corners[i] = {coordinates.data() + static_cast<std::size_t>(mesh.vertices_of(cell)[i]) * d,
                    walls.direction.data() + static_cast<std::size_t>(dofs[i]) * d, walls.distance.values[dofs[i]]};
    }
    double* normal = result.normal.data() + static_cast<std::size_t>(cell) * d;
    double& gap = result.gap[cell];
    for (int i = 0; i <= d; ++i) {
      for (int j = 0; j <= i; ++j) {
        if (std::max(corners[i].distance, corners[j].distance) >= walls.bound) continue;
        if (length(half(corners[i], corners[j], 1, d)) > gamma) continue;
        gap = gap_of_pair(corners[i], corners[j], d, gap, normal);
      }
    }
    bool has_normal = false;
    for (int k = 0; k < d; ++k) has_normal = has_normal || normal[k] != 0;
    if (std::isfinite(gap) && !has_normal) take_steepest({corners.data(), static_cast<std::size_t>(d) + 1}, d, normal);
  }
  return result;
}

}  // namespace vocalis::contact
