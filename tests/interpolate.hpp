#pragma once

#include <functional>
#include <span>
#include <vector>

#include "core/fem/field.hpp"

namespace vocalis::fem {

/// The Lagrange interpolant of a function that reads `dimension` coordinates [m] and writes `components` values: the
/// function at every local dof, ghosts too, so that no messages are needed.
inline Field interpolate(const Space& space, int components,
                         const std::function<void(std::span<const double> point, std::span<double> values)>& function) {
  Field field(space, components);
  const std::vector<double> points = dof_points(space);
  const std::size_t d = static_cast<std::size_t>(space.mesh->dimension);
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    function({points.data() + dof * d, d}, {field.at(dof), static_cast<std::size_t>(components)});
  }
  return field;
}

}  // namespace vocalis::fem
