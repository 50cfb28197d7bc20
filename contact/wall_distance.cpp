#include "contact/wall_distance.hpp"

#include <algorithm>
#include <utility>

#include "contact/mean_directions.hpp"
#include "contact/nearest_facet.hpp"

namespace vocalis::contact {

namespace {

bool is_zero(const double* vector, int dimension) {
  return std::all_of(vector, vector + dimension, [](double value) { return value == 0; });
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
  take_mean_on_planes(result.distance, coordinates, planes, result.direction);
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
  const std::vector<double> normals = std::exchange(result.direction, {});
  std::vector<double> smooth;  // for the first solution: none
  report = EikonalReport{};
  for (int solves = 0; solves <= settings.corrections; ++solves) {
    const EikonalReport solved = eikonal.solve(coordinates, on_wall, planes, settings, smooth, result.distance);
    report = {solved.converged, report.iterations + solved.iterations,
              report.linear_iterations + solved.linear_iterations, solved.reason};
    result.direction = mean_directions(result.distance, normals, coordinates, planes);
    if (!solved.converged) break;
    smooth = smoothness(space, coordinates, result.direction);
  }
  return result;
}

}  // namespace vocalis::contact
