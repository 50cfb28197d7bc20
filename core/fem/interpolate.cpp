#include "core/fem/interpolate.hpp"

namespace vocalis::fem {

Field interpolate(const Space& space, int components, const PointFunction& function) {
  Field field(space, components);
  const std::vector<double> points = dof_points(space);
  const std::size_t d = static_cast<std::size_t>(space.mesh->dimension);
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    function({points.data() + dof * d, d}, {field.at(dof), static_cast<std::size_t>(components)});
  }
  return field;
}

}  // namespace vocalis::fem
