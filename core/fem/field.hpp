#pragma once

#include <algorithm>
#include <vector>

#include "core/fem/space.hpp"

namespace vocalis::fem {

/// Values of a finite element function: `components` numbers at each local dof. A field is carried to another mesh by
/// injection.
struct Field {
  const Space* space = nullptr;  ///< must outlive the field
  int components = 1;
  std::vector<double> values;  ///< (dofs.num_local, components)

  Field() = default;
  Field(const Space& on, int number_of_components)
      : space(&on),
        components(number_of_components),
        values(static_cast<std::size_t>(on.num_dofs()) * number_of_components, 0.0) {}
  double* at(std::int32_t dof) { return values.data() + static_cast<std::size_t>(dof) * components; }
  const double* at(std::int32_t dof) const { return values.data() + static_cast<std::size_t>(dof) * components; }
  /// ghosts := owner's values. Collective.
  void copy_to_ghosts() { space->halo.copy_to_ghosts(values, components); }
};

/// Integrals against the basis functions, as each rank has summed them over its own cells; whole at the owner after
/// `add_to_owners`. A load is carried to another mesh by the transpose of injection, so that totals are conserved.
struct Load {
  const Space* space = nullptr;
  int components = 1;
  std::vector<double> values;  ///< (dofs.num_local, components)

  Load() = default;
  Load(const Space& on, int number_of_components)
      : space(&on),
        components(number_of_components),
        values(static_cast<std::size_t>(on.num_dofs()) * number_of_components, 0.0) {}
  double* at(std::int32_t dof) { return values.data() + static_cast<std::size_t>(dof) * components; }
  const double* at(std::int32_t dof) const { return values.data() + static_cast<std::size_t>(dof) * components; }
  /// owner := sum over all ranks; ghosts := 0, so that the total over all local entries is unchanged. Collective.
  void add_to_owners() {
    space->halo.add_to_owners(values, components);
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(space->dofs.num_owned) * components, values.end(), 0.0);
  }
};

}  // namespace vocalis::fem
