#include "fsi_solver/stabilisation.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::fsi {

Stabilisation::Stabilisation(const mesh::Mesh& mesh)
    : pressure(mesh.num_cells()),
      stream(mesh.num_cells()),
      divergence(mesh.num_cells()),
      recovery(mesh.num_cells()),
      advection(static_cast<std::size_t>(mesh.num_cells()) * mesh.dimension),
      projection(static_cast<std::size_t>(mesh.num_cells()) * mesh.dimension) {}

template <int D>
CellStabilisation<D> Stabilisation::of_cell(std::int32_t cell) const {
  CellStabilisation<D> one = {pressure[cell], stream[cell], divergence[cell], {}, {}};
  std::copy_n(advection.begin() + static_cast<std::ptrdiff_t>(cell) * D, D, one.advection.begin());
  std::copy_n(projection.begin() + static_cast<std::ptrdiff_t>(cell) * D, D, one.projection.begin());
  return one;
}

namespace {

/// What τ is made of in a cell.
template <int D>
struct CellScales {
  double squares = 0;                    ///< Σ_a |∇φ_a|² [1/m^2]
  double crossing = 0;                   ///< Σ_a |c·∇φ_a| [1/s]
  double speed = 0;                      ///< |c| [m/s]
  Matrix<D> velocity_gradient = {};      ///< ∇v [1/s]
  std::array<double, D> advection = {};  ///< c, the mean of the slip [m/s]
  std::array<double, D> slope = {};      ///< ∇p [Pa/m]
};

template <int D>
CellScales<D> scales_of(const CellInput<D>& in) {
  CellScales<D> result;
  const auto& g = in.geometry.gradient;
  auto& c = result.advection;
  for (int a = 0; a <= D; ++a) {
    for (int k = 0; k < D; ++k) c[k] += in.slip[a][k] / (D + 1);
  }
  for (int a = 0; a <= D; ++a) {
    double along = 0;
    for (int k = 0; k < D; ++k) {
      result.squares += g[a][k] * g[a][k];
      along += c[k] * g[a][k];
      result.slope[k] += in.pressure[a] * g[a][k];
      for (int i = 0; i < D; ++i) result.velocity_gradient[i][k] += in.velocity[a][i] * g[a][k];
    }
    result.crossing += std::abs(along);
  }
  for (int k = 0; k < D; ++k) result.speed += c[k] * c[k];
  result.speed = std::sqrt(result.speed);
  return result;
}

template <int D>
void set_fluid(const CellScales<D>& scales, const FlowSettings& settings, std::int32_t cell, Stabilisation& out) {
  const double viscous = settings.viscosity * scales.squares, rho = settings.density;
  out.pressure[cell] = 1 / (rho * scales.speed * std::sqrt(scales.squares) + viscous);
  out.stream[cell] = rho * rho / (rho * scales.crossing + viscous);
  out.divergence[cell] = settings.viscosity + rho * scales.speed / std::sqrt(scales.squares);
}

template <int D>
void set_solid(const CellScales<D>& scales, const SolidMaterial& material, const Elasticity& elasticity,
               std::int32_t cell, Stabilisation& out) {
  const double shear_speed = std::sqrt(elasticity.shear / material.density);
  out.pressure[cell] =
      1 / (material.density * shear_speed * std::sqrt(scales.squares) + material.damping * scales.squares);
  out.recovery[cell] = 0.5 * shear_speed * std::sqrt(scales.squares);
}

/// Lumped projection, a weighted mean of the cells' values at each dof: `sums` holds D sums of weight × value, then
/// that of the weights. Zero where no cell has a say; ghosts current. Collective.
template <int D>
fem::Field projection_of(fem::Load& sums) {
  sums.add_to_owners();
  fem::Field result(*sums.space, D);
  for (std::int32_t dof = 0; dof < sums.space->dofs.num_owned; ++dof) {
    const double* sum = sums.at(dof);
    for (int k = 0; k < D && sum[D] > 0; ++k) result.at(dof)[k] = sum[k] / sum[D];
  }
  result.copy_to_ghosts();
  return result;
}

}  // namespace

template <int D>
fem::Field stabilise(const StageFields& fields, const Continuum& continuum, const FlowSettings& settings,
                     Stabilisation& stabilisation) {
  const mesh::Mesh& mesh = *continuum.mesh;
  fem::Load streams(continuum.velocity_space, D + 1);
  fem::Load slopes(continuum.pressure_space, D + 1);
  CellInput<D> in{};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int32_t solid = continuum.cell_solid[cell];
    stabilisation.pressure[cell] = stabilisation.stream[cell] = stabilisation.divergence[cell] = 0;
    if (!continuum.has_pressure(cell)) continue;
    fields.gather(cell, in);
    const double measure = in.geometry.measure;
    const CellScales<D> scales = scales_of(in);
    const auto& c = scales.advection;
    std::copy_n(c.begin(), D, stabilisation.advection.begin() + static_cast<std::ptrdiff_t>(cell) * D);
    if (solid < 0) {
      set_fluid(scales, settings, cell, stabilisation);
      const double weight = stabilisation.stream[cell] * measure / (D + 1);
      for (const std::int32_t vertex : mesh.vertices_of(cell)) {
        double* sum = streams.at(vertex);
        sum[D] += weight;
        for (int i = 0; i < D; ++i) {
          for (int k = 0; k < D; ++k) sum[i] += weight * scales.velocity_gradient[i][k] * c[k];
        }
      }
    } else {
      set_solid(scales, continuum.solids[solid], continuum.elasticity[solid], cell, stabilisation);
    }
    const double weight = stabilisation.pressure[cell] * measure / (D + 1);
    for (const std::int32_t dof : continuum.pressure_space.dofs_of(cell)) {
      double* sum = slopes.at(dof);
      sum[D] += weight;
      for (int k = 0; k < D; ++k) sum[k] += weight * scales.slope[k];
    }
  }
  const fem::Field stream = projection_of<D>(streams);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double* mean = stabilisation.projection.data() + static_cast<std::size_t>(cell) * D;
    std::fill(mean, mean + D, 0.0);
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      for (int k = 0; k < D; ++k) mean[k] += stream.at(vertex)[k] / (D + 1);
    }
  }
  return projection_of<D>(slopes);
}

#define VOCALIS_INSTANTIATE(D)                                                 \
  template CellStabilisation<D> Stabilisation::of_cell<D>(std::int32_t) const; \
  template fem::Field stabilise<D>(const StageFields&, const Continuum&, const FlowSettings&, Stabilisation&);
VOCALIS_INSTANTIATE(2)
VOCALIS_INSTANTIATE(3)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
