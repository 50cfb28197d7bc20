#include "fsi_solver/solution/stabilisation.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::fsi {

Stabilisation::Stabilisation(const Continuum& continuum)
    : pressure(continuum.mesh->num_cells()),
      stream(continuum.mesh->num_cells()),
      divergence(continuum.mesh->num_cells()),
      recovery(continuum.mesh->num_cells()),
      advection(static_cast<std::size_t>(continuum.mesh->num_cells()) * continuum.mesh->dimension),
      projection(continuum.vertex_space, continuum.mesh->dimension) {}

template <int D>
CellStabilisation<D> Stabilisation::of_batch(const CellBatches& batches, std::size_t batch) const {
  CellStabilisation<D> result;
  result.of_pressure = of_pressure;
  const std::int32_t* vertices = batches.vertices_of(batch);
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::size_t cell = batches.batches[batch].cell[lane];
    result.pressure[lane] = pressure[cell];
    result.stream[lane] = stream[cell];
    result.divergence[lane] = divergence[cell];
    result.recovery[lane] = recovery[cell];
    for (int k = 0; k < D; ++k) {
      result.advection[k][lane] = advection[cell * D + k];
      for (int b = 0; b <= D; ++b) result.projection[b][k][lane] = projection.at(vertices[b * lane_count + lane])[k];
    }
  }
  return result;
}

namespace {

/// What τ is made of in cells.
template <int D, int Degree>
struct CellScales {
  Lanes measure{};              ///< [m^D]
  Lanes squares{};              ///< Σ_a |∇φ_a|² [1/m^2]
  Lanes crossing{};             ///< Σ_a |c·∇φ_a| [1/s]
  Lanes speed{};                ///< |c| [m/s]
  Lanes advection[D]{};         ///< c, the mean of the slip [m/s]
  Lanes streaming[D + 1][D]{};  ///< ∫ λ_b (c·∇)v
  Lanes slope[D]{};             ///< ∇p [Pa/m]
};

template <int D, int Degree>
CellScales<D, Degree> scales_of(const CellInput<D, Degree>& in) {
  using E = Element<D, Degree>;
  CellScales<D, Degree> result;
  auto& c = result.advection;
  Lanes g[D + 1][D]{};  // mean gradients of the corners' basis
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Lanes weight = point.weight * geometry.determinant;
    const auto slip = value_of<D, E::nodes>(in.slip, point.value);
    result.measure += weight;
    for (int k = 0; k < D; ++k) {
      c[k] += weight * slip[k];
      for (int b = 0; b <= D; ++b) g[b][k] += weight * geometry.corner_gradient[b][k];
    }
  }
  for (int k = 0; k < D; ++k) c[k] /= result.measure;
  for (int b = 0; b <= D; ++b) {
    Lanes along{};
    for (int k = 0; k < D; ++k) {
      g[b][k] /= result.measure;
      result.squares += g[b][k] * g[b][k];
      along += c[k] * g[b][k];
      result.slope[k] += in.pressure[b] * g[b][k];
    }
    result.crossing += absolute(along);
  }
  constexpr double refinement = Degree;
  result.squares *= refinement * refinement;
  result.crossing *= refinement;
  for (int k = 0; k < D; ++k) result.speed += c[k] * c[k];
  result.speed = square_root(result.speed);
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Matrix<D, Lanes> l = gradient_of<D, E::nodes>(in.velocity, geometry.gradient);
    for (int i = 0; i < D; ++i) {
      Lanes sum{};
      for (int k = 0; k < D; ++k) sum += l[i][k] * c[k];
      for (int b = 0; b <= D; ++b) {
        result.streaming[b][i] += point.weight * geometry.determinant * sum * point.corner[b];
      }
    }
  }
  return result;
}

/// Sets what a fluid cell has, from its scales.
void set_fluid(double squares, double crossing, double speed, const FlowSettings& settings, std::size_t cell,
               Stabilisation& out) {
  const double viscous = settings.viscosity * squares, rho = settings.density;
  out.pressure[cell] = 1 / (rho * speed * std::sqrt(squares) + viscous);
  if (!settings.streamline_stabilisation) return;
  out.stream[cell] = rho * rho / (rho * crossing + viscous);
  out.divergence[cell] = settings.viscosity + rho * speed / std::sqrt(squares);
}

void set_solid(double squares, const SolidMaterial& material, const Elasticity& elasticity, std::size_t cell,
               Stabilisation& out) {
  const double shear_speed = std::sqrt(elasticity.shear / material.density);
  out.pressure[cell] = 1 / (material.density * shear_speed * std::sqrt(squares) + material.damping * squares);
  out.recovery[cell] = 0.5 * shear_speed * std::sqrt(squares);
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

bool needs_stabilisation(const Continuum& continuum, const FlowSettings& settings) {
  const bool recovers = std::any_of(continuum.solids.begin(), continuum.solids.end(),
                                    [](const SolidMaterial& solid) { return solid.incompressible; });
  return continuum.velocity_space.degree == 1 || settings.streamline_stabilisation || recovers;
}

template <int D, int Degree>
fem::Field stabilise(const StageFields& fields, const Continuum& continuum, const FlowSettings& settings,
                     Stabilisation& stabilisation) {
  constexpr bool of_pressure = Element<D, Degree>::is_stabilised;
  fem::Load streams(continuum.vertex_space, D + 1);
  fem::Load slopes(continuum.pressure_space, D + 1);
  stabilisation.of_pressure = settings.pressure_stabilisation ? 1 : 0;
  for (auto* values : {&stabilisation.pressure, &stabilisation.stream, &stabilisation.divergence}) {
    std::fill(values->begin(), values->end(), 0.0);
  }
  CellInput<D, Degree> in{};
  const CellBatches& batches = continuum.batches;
  for (std::size_t batch = 0; batch < batches.batches.size(); ++batch) {
    const auto& [solid, active, cells] = batches.batches[batch];
    if (!continuum.has_pressure(cells[0])) continue;
    fields.gather(batches, batch, in);
    const CellScales<D, Degree> scales = scales_of<D, Degree>(in);
    const std::int32_t* vertices = batches.vertices_of(batch);
    const std::int32_t* dofs = batches.pressure_dofs_of(batch);
    for (int lane = 0; lane < active; ++lane) {
      const std::size_t cell = cells[lane];
      if (solid < 0) {
        set_fluid(scales.squares[lane], scales.crossing[lane], scales.speed[lane], settings, cell, stabilisation);
      } else {
        set_solid(scales.squares[lane], continuum.solids[solid], continuum.elasticity[solid], cell, stabilisation);
        // Contact cells share their pressure with the air beside them, which would flow out of what κ pulls back.
        if (solid == continuum.contact) stabilisation.recovery[cell] = 0;
      }
      for (int k = 0; k < D; ++k) stabilisation.advection[cell * D + k] = scales.advection[k][lane];
      const double share = scales.measure[lane] / (D + 1);
      const double stream = stabilisation.stream[cell], slope = stabilisation.pressure[cell] * share;
      for (int b = 0; b <= D; ++b) {
        double* sum = streams.at(vertices[b * lane_count + lane]);
        sum[D] += stream * share;
        for (int k = 0; k < D; ++k) sum[k] += stream * scales.streaming[b][k][lane];
        if (!of_pressure) continue;
        double* slope_sum = slopes.at(dofs[b * lane_count + lane]);
        slope_sum[D] += slope;
        for (int k = 0; k < D; ++k) slope_sum[k] += slope * scales.slope[k][lane];
      }
    }
  }
  stabilisation.projection = projection_of<D>(streams);
  return projection_of<D>(slopes);
}

#define VOCALIS_INSTANTIATE(D, Degree) \
  template fem::Field stabilise<D, Degree>(const StageFields&, const Continuum&, const FlowSettings&, Stabilisation&);
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE
template CellStabilisation<2> Stabilisation::of_batch<2>(const CellBatches&, std::size_t) const;
template CellStabilisation<3> Stabilisation::of_batch<3>(const CellBatches&, std::size_t) const;

}  // namespace vocalis::fsi
