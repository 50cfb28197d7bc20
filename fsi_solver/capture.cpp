#include "fsi_solver/capture.hpp"

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "fsi_solver/cells/element.hpp"

namespace vocalis::fsi {

namespace {

/// ∫ ½ ρ|v|² over cells that are air or contact, taken as straight where they are now.
template <int D, int Degree>
double kinetic_energy(const Continuum& continuum, double density, const State& state) {
  using E = Element<D, Degree>;
  const fem::Space& space = continuum.velocity_space;
  double total = 0;
  for (std::int32_t cell = 0; cell < continuum.mesh->num_cells(); ++cell) {
    const std::int32_t solid = continuum.cell_solid[cell];
    if (solid >= 0 && solid != continuum.contact) continue;
    const auto dofs = space.dofs_of(cell);
    std::array<std::array<double, D>, D + 1> places;
    std::array<const double*, D + 1> corners;
    for (int i = 0; i <= D; ++i) {
      for (int k = 0; k < D; ++k) {
        places[i][k] =
            continuum.reference_points[static_cast<std::size_t>(dofs[i]) * D + k] + state.displacement.at(dofs[i])[k];
      }
      corners[i] = places[i].data();
    }
    const double measure = fem::simplex_geometry<D>(corners).measure;
    double sum = 0, weights = 0;
    for (const typename E::Point& point : E::points()) {
      double square = 0;
      for (int k = 0; k < D; ++k) {
        double velocity = 0;
        for (int a = 0; a < E::nodes; ++a) velocity += point.value[a] * state.velocity.at(dofs[a])[k];
        square += velocity * velocity;
      }
      sum += point.weight * square;
      weights += point.weight;
    }
    total += 0.5 * density * measure * sum / weights;
  }
  return total;
}

double kinetic_energy(const Continuum& continuum, double density, const State& state) {
  double total = 0;
  with_element(continuum.velocity_space,
               [&]<int D, int Degree>() { total = kinetic_energy<D, Degree>(continuum, density, state); });
  return base::sum(continuum.mesh->comm, total);
}

}  // namespace

double capture(const Continuum& continuum, std::span<const std::int32_t> dof_solid_before, double density,
               State& state) {
  const double before = kinetic_energy(continuum, density, state);
  const int d = continuum.mesh->dimension;
  for (std::int32_t dof = 0; dof < continuum.velocity_space.num_dofs(); ++dof) {
    if (dof_solid_before[dof] >= 0 || continuum.dof_solid[dof] != continuum.contact) continue;
    for (int k = 0; k < d; ++k) {
      const double way = state.displacement.at(dof)[k] - state.displacement_before.at(dof)[k];
      const double velocity = state.last_dt > 0 ? way / state.last_dt : 0;
      state.velocity.at(dof)[k] = state.velocity_before.at(dof)[k] = velocity;
      state.acceleration.at(dof)[k] = 0;
    }
  }
  return before - kinetic_energy(continuum, density, state);
}

}  // namespace vocalis::fsi
