#include "core/mesh/locate.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::mesh {

namespace {

double volume_with(const Mesh& mesh, std::int32_t cell, int replaced, const std::array<double, 3>& point) {
  std::array<std::array<double, 3>, 4> corners{};
  const auto vertices = mesh.vertices_of(cell);
  for (int i = 0; i <= mesh.dimension; ++i) {
    for (int k = 0; k < mesh.dimension; ++k) corners[i][k] = i == replaced ? point[k] : mesh.point(vertices[i])[k];
  }
  std::array<std::array<double, 3>, 3> e{};
  for (int i = 0; i < mesh.dimension; ++i) {
    for (int k = 0; k < 3; ++k) e[i][k] = corners[i + 1][k] - corners[0][k];
  }
  if (mesh.dimension == 2) return 0.5 * (e[0][0] * e[1][1] - e[0][1] * e[1][0]);
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

}  // namespace

std::array<double, 4> barycentric_coordinates(const Mesh& mesh, std::int32_t cell, const std::array<double, 3>& point) {
  std::array<double, 4> result = {0, 0, 0, 0};
  const double volume = signed_volume(mesh, mesh.vertices_of(cell));
  for (int i = 0; i <= mesh.dimension; ++i) result[i] = volume_with(mesh, cell, i, point) / volume;
  return result;
}

Location locate(const Mesh& mesh, const std::array<double, 3>& point) {
  constexpr double rounding = 1e-10;
  Location best;
  double depth = -rounding;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto coordinates = barycentric_coordinates(mesh, cell, point);
    const double lowest = *std::min_element(coordinates.begin(), coordinates.begin() + mesh.dimension + 1);
    if (lowest < depth || (lowest == depth && best.cell >= 0)) continue;
    depth = lowest;
    best.cell = cell;
    best.barycentric = coordinates;
  }
  const auto depths = base::gather_all(mesh.comm, best.cell >= 0 ? depth : -1.0);
  const auto deepest = std::max_element(depths.begin(), depths.end());
  if (*deepest > -1.0) best.rank = static_cast<int>(deepest - depths.begin());
  return best;
}

}  // namespace vocalis::mesh
