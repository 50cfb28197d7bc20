#include "fsi_solver/assembly.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "fsi_solver/cell_terms.hpp"

namespace vocalis::fsi {

Assembly::Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
                   const Prescribed& prescribed, MeshMotion* motion)
    : continuum_(continuum),
      settings_(settings),
      conditions_(conditions),
      prescribed_(prescribed),
      motion_(motion),
      moves_(continuum.has_solid || prescribed.mesh_displacement),
      has_forces_(prescribed.fluid_force || prescribed.solid_force || settings.gravity != std::array<double, 3>{}) {
  const mesh::Mesh& mesh = *continuum.mesh;
  const int d = mesh.dimension;
  const fem::Space& velocities = continuum.velocity_space;
  const fem::Space& pressures = continuum.pressure_space;
  layout_ = la::SystemLayout(mesh.comm, {{&velocities.dofs, d}, {&pressures.dofs, 1}, {&pressures.dofs, d}});
  for (const PrescribedComponent& entry : conditions.components) {
    if (entry.vertex < mesh.vertices.num_owned) held_rows_.push_back(entry.vertex * d + entry.component);
  }
  // Fluid between walls alone: the pressure is known up to a constant, its first unknown is set to 0.
  if (continuum.has_fluid && !continuum.has_solid && !conditions.sets_pressure_level && pressures.dofs.offset == 0 &&
      pressures.dofs.num_owned > 0) {
    held_rows_.push_back(layout_.start(1));
  }
  std::vector<PetscInt> rows;
  const int count = (d + 1) * (2 * d + 1);
  rows.reserve(static_cast<std::size_t>(mesh.num_cells()) * count);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = pressures.dofs_of(cell);
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      for (int k = 0; k < d; ++k) rows.push_back(layout_.global(0, vertex, k));
    }
    for (const std::int32_t dof : dofs) rows.push_back(dof < 0 ? -1 : layout_.global(1, dof, 0));
    for (const std::int32_t dof : dofs) {
      for (int k = 0; k < d; ++k) rows.push_back(dof < 0 ? -1 : layout_.global(2, dof, k));
    }
  }
  matrix_ = std::make_unique<la::AssembledMatrix>(layout_, rows, count, held_rows_, true);
  cell_matrices_.resize(static_cast<std::size_t>(mesh.num_cells()) * count * count);

  velocity_ = displacement_ = fem::Field(velocities, d);
  pressure_ = fem::Field(pressures, 1);
  gradient_ = fem::Field(pressures, d);
  momentum_ = fem::Load(velocities, d);
  mass_ = fem::Load(pressures, 1);
  slope_ = fem::Load(pressures, d);
  stage_velocity_ = stage_rate_ = velocity_.values;
  if (moves_) stage_displacement_ = mesh_velocity_ = velocity_.values;
  if (has_forces_) fluid_force_ = solid_force_ = velocity_.values;
  const std::size_t cells = mesh.num_cells();
  stabilisation_ = {std::vector<double>(cells), std::vector<double>(cells),     std::vector<double>(cells),
                    std::vector<double>(cells), std::vector<double>(cells * d), std::vector<double>(cells * d)};
}

void Assembly::begin_step(const State& state, const Stage& stage, Vec unknowns) {
  state_ = &state;
  stage_ = stage;
  first_guess(unknowns);
  follow(unknowns);
  if (continuum_.mesh->dimension == 2) {
    stabilise<2>();
  } else {
    stabilise<3>();
  }
  const la::OwnedValues values(unknowns);
  layout_.copy_owned_to_system(2, gradient_.values, values.data());
}

void Assembly::first_guess(Vec unknowns) const {
  fem::Field guess = state_->velocity;
  const double ratio = state_->last_dt > 0 ? stage_.dt / state_->last_dt : 0;
  for (std::size_t i = 0; i < guess.values.size(); ++i) {
    guess.values[i] += ratio * (guess.values[i] - state_->velocity_before.values[i]);
  }
  const mesh::Mesh& mesh = *continuum_.mesh;
  std::vector<double> coordinates = mesh.coordinates;
  const double end = state_->time + stage_.dt;
  const int d = mesh.dimension;
  if (prescribed_.mesh_displacement) {
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      std::array<double, 3> point = {0, 0, 0};
      std::copy_n(mesh.point(v), d, point.begin());
      const auto displacement = prescribed_.mesh_displacement(point, end);
      for (int k = 0; k < d; ++k) coordinates[static_cast<std::size_t>(v) * d + k] += displacement[k];
    }
  }
  impose(conditions_, continuum_, prescribed_, coordinates, end, guess);
  const la::OwnedValues values(unknowns);
  layout_.copy_owned_to_system(0, guess.values, values.data());
  layout_.copy_owned_to_system(1, state_->pressure.values, values.data());
}

void Assembly::follow(Vec unknowns) {
  {
    const la::ReadValues values(unknowns);
    layout_.copy_owned(0, values.data(), velocity_.values);
    layout_.copy_owned(1, values.data(), pressure_.values);
    layout_.copy_owned(2, values.data(), gradient_.values);
  }
  velocity_.copy_to_ghosts();
  pressure_.copy_to_ghosts();
  gradient_.copy_to_ghosts();
  const State& now = *state_;
  for (std::size_t i = 0; i < velocity_.values.size(); ++i) {
    stage_velocity_[i] = stage_.at_stage(velocity_.values[i], now.velocity.values[i]);
    stage_rate_[i] = stage_.rate_of(velocity_.values[i], now.velocity.values[i], now.velocity_before.values[i]);
  }
  if (!moves_) return;
  const mesh::Mesh& mesh = *continuum_.mesh;
  const int d = mesh.dimension;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    if (continuum_.vertex_solid[v] >= 0) {
      for (int k = 0; k < d; ++k) {
        displacement_.at(v)[k] = stage_.end_displacement(stage_velocity_[static_cast<std::size_t>(v) * d + k],
                                                         now.displacement.at(v)[k], now.displacement_before.at(v)[k]);
      }
    } else if (prescribed_.mesh_displacement) {
      std::array<double, 3> point = {0, 0, 0};
      std::copy_n(mesh.point(v), d, point.begin());
      const auto value = prescribed_.mesh_displacement(point, now.time + stage_.dt);
      std::copy_n(value.begin(), d, displacement_.at(v));
    }
  }
  if (motion_ && !prescribed_.mesh_displacement) motion_->extend(displacement_);
  for (std::size_t i = 0; i < displacement_.values.size(); ++i) {
    const double end = displacement_.values[i];
    stage_displacement_[i] = stage_.at_stage(end, now.displacement.values[i]);
    mesh_velocity_[i] = stage_.rate_of(end, now.displacement.values[i], now.displacement_before.values[i]);
  }
}

void Assembly::find_forces() {
  const mesh::Mesh& mesh = *continuum_.mesh;
  const int d = mesh.dimension;
  const double time = state_->time + stage_.weight * stage_.dt;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const std::size_t first = static_cast<std::size_t>(v) * d;
    std::array<double, 3> reference = {0, 0, 0};
    std::copy_n(mesh.point(v), d, reference.begin());
    std::array<double, 3> moved = reference, fluid = {0, 0, 0}, solid = {0, 0, 0};
    for (int k = 0; k < d && moves_; ++k) moved[k] += stage_displacement_[first + k];
    if (prescribed_.fluid_force) fluid = prescribed_.fluid_force(moved, time);
    if (prescribed_.solid_force) solid = prescribed_.solid_force(reference, time);
    std::copy_n(fluid.begin(), d, fluid_force_.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy_n(solid.begin(), d, solid_force_.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

/// Fills the input of a cell's integrals from the stage.
template <int D, class Cell>
void Assembly::gather(std::int32_t cell, Cell& in) const {
  const mesh::Mesh& mesh = *continuum_.mesh;
  const std::int32_t solid = continuum_.cell_solid[cell];
  const std::int32_t* vertices = mesh.cell_vertices.data() + static_cast<std::size_t>(cell) * (D + 1);
  const std::int32_t* dofs = continuum_.pressure_space.cell_dofs.data() + static_cast<std::size_t>(cell) * (D + 1);
  in.largest_rate = stage_.rate;
  in.density = solid < 0 ? settings_.density : continuum_.solids[solid].density;
  const std::vector<double>& force = solid < 0 ? fluid_force_ : solid_force_;
  double points[D + 1][D];
  std::array<const double*, D + 1> corners;
  for (int a = 0; a <= D; ++a) {
    const std::size_t first = static_cast<std::size_t>(vertices[a]) * D;
    corners[a] = points[a];
    for (int k = 0; k < D; ++k) {
      points[a][k] = mesh.coordinates[first + k];
      in.velocity[a][k] = in.slip[a][k] = stage_velocity_[first + k];
      in.inertia[a][k] = in.density * (stage_rate_[first + k] - settings_.gravity[k]);
      if (has_forces_) in.inertia[a][k] -= force[first + k];
      if (moves_) {
        in.displacement[a][k] = stage_displacement_[first + k];
        in.slip[a][k] -= mesh_velocity_[first + k];
        if (solid < 0) points[a][k] += stage_displacement_[first + k];
      }
    }
    if (dofs[a] >= 0) {
      in.pressure[a] = pressure_.values[dofs[a]];
      for (int k = 0; k < D; ++k) in.gradient[a][k] = gradient_.values[static_cast<std::size_t>(dofs[a]) * D + k];
    }
  }
  in.geometry = fem::simplex_geometry<D>(corners);
}

namespace {

template <int D>
CellStabilisation<D> of_cell(const Stabilisation& all, std::int32_t cell) {
  CellStabilisation<D> one = {all.pressure[cell], all.stream[cell], all.divergence[cell], {}, {}};
  std::copy_n(all.advection.begin() + static_cast<std::ptrdiff_t>(cell) * D, D, one.advection.begin());
  std::copy_n(all.projection.begin() + static_cast<std::ptrdiff_t>(cell) * D, D, one.projection.begin());
  return one;
}

/// Flow into the domain through a facet, -β ρ min(c·n, 0) |facet| with c its mean there; 0 if it flows out.
template <int D>
double backflow(const CellInput<D>& in, int facet, double weight) {
  double through = 0;
  for (int a = 0; a <= D; ++a) {
    if (a == facet) continue;
    for (int k = 0; k < D; ++k) through -= in.slip[a][k] * in.geometry.gradient[facet][k];
  }
  // n |facet| = -D |cell| ∇φ_facet; the mean over D corners cancels D.
  return -weight * in.density * std::min(0.0, through * in.geometry.measure);
}

/// β of a boundary. With ½ the inflow brings ½ρ|v|² less pressure: the given pressure is the total one, and the power
/// that enters is that pressure times the flow, whatever eddies there are.
double backflow_weight(const FlowBoundary& boundary, double at_outlets) {
  if (boundary.kind == FlowBoundaryKind::total_pressure) return 0.5;
  return boundary.kind == FlowBoundaryKind::outlet ? at_outlets : 0;
}

template <int D>
double facet_mass(int a, int b) {
  return (a == b ? 2.0 : 1.0) / (D * (D + 1));
}

}  // namespace

template <int D>
void Assembly::stabilise() {
  const mesh::Mesh& mesh = *continuum_.mesh;
  fem::Load streams(continuum_.velocity_space, D + 1);
  fem::Load slopes(continuum_.pressure_space, D + 1);
  CellInput<D> in{};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int32_t solid = continuum_.cell_solid[cell];
    stabilisation_.pressure[cell] = stabilisation_.stream[cell] = stabilisation_.divergence[cell] = 0;
    if (!continuum_.has_pressure(cell)) continue;
    const auto vertices = mesh.vertices_of(cell);
    gather<D>(cell, in);
    const auto& [g, measure] = in.geometry;
    double* c = stabilisation_.advection.data() + static_cast<std::size_t>(cell) * D;
    std::fill(c, c + D, 0.0);
    for (int a = 0; a <= D; ++a) {
      for (int k = 0; k < D; ++k) c[k] += in.slip[a][k] / (D + 1);
    }
    double squares = 0, crossing = 0, speed = 0, l[D][D] = {}, slope[D] = {};
    for (int a = 0; a <= D; ++a) {
      double along = 0;
      for (int k = 0; k < D; ++k) {
        squares += g[a][k] * g[a][k];
        along += c[k] * g[a][k];
        slope[k] += in.pressure[a] * g[a][k];
        for (int i = 0; i < D; ++i) l[i][k] += in.velocity[a][i] * g[a][k];
      }
      crossing += std::abs(along);
    }
    for (int k = 0; k < D; ++k) speed += c[k] * c[k];
    speed = std::sqrt(speed);
    if (solid < 0) {
      const double viscous = settings_.viscosity * squares, rho = settings_.density;
      stabilisation_.pressure[cell] = 1 / (rho * speed * std::sqrt(squares) + viscous);
      stabilisation_.stream[cell] = rho * rho / (rho * crossing + viscous);
      stabilisation_.divergence[cell] = settings_.viscosity + rho * speed / std::sqrt(squares);
      const double weight = stabilisation_.stream[cell] * measure / (D + 1);
      for (const std::int32_t vertex : vertices) {
        double* sum = streams.at(vertex);
        sum[D] += weight;
        for (int i = 0; i < D; ++i) {
          for (int k = 0; k < D; ++k) sum[i] += weight * l[i][k] * c[k];
        }
      }
    } else {
      const SolidMaterial& material = continuum_.solids[solid];
      const double shear_speed = std::sqrt(continuum_.elasticity[solid].shear / material.density);
      stabilisation_.pressure[cell] =
          1 / (material.density * shear_speed * std::sqrt(squares) + material.damping * squares);
      stabilisation_.recovery[cell] = 0.5 * shear_speed * std::sqrt(squares);
    }
    const double weight = stabilisation_.pressure[cell] * measure / (D + 1);
    for (const std::int32_t dof : continuum_.pressure_space.dofs_of(cell)) {
      double* sum = slopes.at(dof);
      sum[D] += weight;
      for (int k = 0; k < D; ++k) sum[k] += weight * slope[k];
    }
  }
  streams.add_to_owners();
  slopes.add_to_owners();
  fem::Field stream(continuum_.velocity_space, D);
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    for (int k = 0; k < D && streams.at(v)[D] > 0; ++k) stream.at(v)[k] = streams.at(v)[k] / streams.at(v)[D];
  }
  for (std::int32_t dof = 0; dof < continuum_.pressure_space.dofs.num_owned; ++dof) {
    for (int k = 0; k < D; ++k) gradient_.at(dof)[k] = slopes.at(dof)[k] / slopes.at(dof)[D];
  }
  stream.copy_to_ghosts();
  gradient_.copy_to_ghosts();
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double* mean = stabilisation_.projection.data() + static_cast<std::size_t>(cell) * D;
    std::fill(mean, mean + D, 0.0);
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      for (int k = 0; k < D; ++k) mean[k] += stream.at(vertex)[k] / (D + 1);
    }
  }
}

ResidualSize Assembly::residual(Vec unknowns, Vec result) {
  follow(unknowns);
  if (has_forces_) find_forces();
  std::fill(momentum_.values.begin(), momentum_.values.end(), 0.0);
  std::fill(mass_.values.begin(), mass_.values.end(), 0.0);
  std::fill(slope_.values.begin(), slope_.values.end(), 0.0);
  const ResidualSize size = continuum_.mesh->dimension == 2 ? sum_residual<2>() : sum_residual<3>();
  const la::OwnedValues values(result);
  layout_.copy_owned_to_system(0, momentum_.values, values.data());
  layout_.copy_owned_to_system(1, mass_.values, values.data());
  layout_.copy_owned_to_system(2, slope_.values, values.data());
  for (const PetscInt row : held_rows_) values[row] = 0;
  return size;
}

template <int D>
ResidualSize Assembly::sum_residual() {
  using Unknowns = CellUnknowns<D>;
  const mesh::Mesh& mesh = *continuum_.mesh;
  // Blocks: momentum of the fluid and of each solid, then mass of each label, then projection of each label.
  const int labels = continuum_.labels();
  std::vector<double> sums(static_cast<std::size_t>(6 * labels) + 1, 0.0);
  double* sizes = sums.data();
  double* errors = sums.data() + 3 * labels;
  double& inverted = sums.back();
  CellInput<D> in{};
  CellResidual<D> out{};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int32_t solid = continuum_.cell_solid[cell];
    gather<D>(cell, in);
    const CellStabilisation<D> stabilisation = of_cell<D>(stabilisation_, cell);
    if (solid < 0) {
      if (!(in.geometry.measure > 0)) inverted = 1;
      fluid_residual<D>(in, stabilisation, settings_.viscosity, out);
    } else {
      const Elasticity& material = continuum_.elasticity[solid];
      if (!solid_residual<D>(in, stabilisation, material, continuum_.solids[solid].incompressible,
                             stabilisation_.recovery[cell], out)) {
        inverted = 1;
        continue;
      }
    }
    const auto vertices = mesh.vertices_of(cell);
    const auto dofs = continuum_.pressure_space.dofs_of(cell);
    for (int a = 0; a <= D; ++a) {
      double& size = sizes[1 + continuum_.vertex_solid[vertices[a]]];
      double* force = momentum_.at(vertices[a]);
      size += out.momentum_size * out.momentum_size;
      for (int k = 0; k < D; ++k) {
        const double value = out.values[Unknowns::velocity(a, k)];
        force[k] += value;
        size += value * value;
      }
      if (dofs[a] < 0) continue;
      mass_.values[dofs[a]] += out.values[Unknowns::pressure(a)];
      sizes[labels + 1 + solid] += out.mass_size * out.mass_size;
      sizes[2 * labels + 1 + solid] += out.gradient_size * out.gradient_size;
      for (int k = 0; k < D; ++k) slope_.at(dofs[a])[k] += out.values[Unknowns::gradient(a, k)];
    }
  }
  const double time = state_->time + stage_.weight * stage_.dt;
  for (const TractionFacet& facet : conditions_.tractions) {
    const FlowBoundary& boundary = conditions_.boundaries[facet.boundary];
    gather<D>(facet.cell, in);
    const double pressure = boundary.pressure * ramp(boundary, time);
    const double inflow = backflow<D>(in, facet.index, backflow_weight(boundary, settings_.backflow_stabilisation));
    const auto vertices = mesh.vertices_of(facet.cell);
    for (int a = 0; a <= D; ++a) {
      if (a == facet.index) continue;
      double* force = momentum_.at(vertices[a]);
      double& size = sizes[1 + continuum_.vertex_solid[vertices[a]]];
      for (int k = 0; k < D; ++k) {
        double value = -pressure * in.geometry.measure * in.geometry.gradient[facet.index][k];
        for (int b = 0; b <= D; ++b) {
          if (b != facet.index) value += inflow * facet_mass<D>(a, b) * in.velocity[b][k];
        }
        force[k] += value;
        size += value * value;
      }
    }
  }
  momentum_.add_to_owners();
  mass_.add_to_owners();
  slope_.add_to_owners();
  for (const PetscInt row : held_rows_) {
    if (row < layout_.start(1)) {
      momentum_.values[row] = 0;
    } else {
      mass_.values[row - layout_.start(1)] = 0;
    }
  }
  for (std::int32_t v = 0; v < mesh.vertices.num_owned; ++v) {
    for (int k = 0; k < D; ++k) errors[1 + continuum_.vertex_solid[v]] += momentum_.at(v)[k] * momentum_.at(v)[k];
  }
  for (std::int32_t dof = 0; dof < continuum_.pressure_space.dofs.num_owned; ++dof) {
    const std::int32_t label = continuum_.pressure_space.dof_label[dof];
    errors[labels + label] += mass_.values[dof] * mass_.values[dof];
    for (int k = 0; k < D; ++k) errors[2 * labels + label] += slope_.at(dof)[k] * slope_.at(dof)[k];
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM, mesh.comm);
  ResidualSize result;
  result.inverted = inverted > 0;
  for (int block = 0; block < 3 * labels; ++block) {
    if (errors[block] == 0) continue;
    const double error = std::sqrt(errors[block] / sizes[block]);
    result.error = std::isnan(error) ? error : std::max(result.error, error);
    if (std::isnan(result.error)) break;
  }
  return result;
}

void Assembly::jacobian() {
  if (continuum_.mesh->dimension == 2) {
    sum_jacobian<2>();
  } else {
    sum_jacobian<3>();
  }
  matrix_->assemble(cell_matrices_);
}

template <int D>
void Assembly::sum_jacobian() {
  using Unknowns = CellUnknowns<D>;
  constexpr std::size_t entries = Unknowns::count * Unknowns::count;
  CellInput<D> in{};
  for (std::int32_t cell = 0; cell < continuum_.mesh->num_cells(); ++cell) {
    const std::int32_t solid = continuum_.cell_solid[cell];
    gather<D>(cell, in);
    const CellStabilisation<D> stabilisation = of_cell<D>(stabilisation_, cell);
    double* matrix = cell_matrices_.data() + cell * entries;
    if (solid < 0) {
      fluid_jacobian<D>(in, stabilisation, settings_.viscosity, stage_, matrix);
    } else {
      solid_jacobian<D>(in, stabilisation, continuum_.elasticity[solid], continuum_.solids[solid].incompressible,
                        stabilisation_.recovery[cell], stage_, matrix);
    }
  }
  for (const TractionFacet& facet : conditions_.tractions) {
    const double weight = backflow_weight(conditions_.boundaries[facet.boundary], settings_.backflow_stabilisation);
    if (weight == 0) continue;
    gather<D>(facet.cell, in);
    const double inflow = backflow<D>(in, facet.index, weight);
    double* matrix = cell_matrices_.data() + facet.cell * entries;
    for (int a = 0; a <= D; ++a) {
      for (int b = 0; b <= D; ++b) {
        if (a == facet.index || b == facet.index) continue;
        for (int k = 0; k < D; ++k) {
          matrix[Unknowns::velocity(a, k) * Unknowns::count + Unknowns::velocity(b, k)] +=
              stage_.velocity_slope() * inflow * facet_mass<D>(a, b);
        }
      }
    }
  }
}

}  // namespace vocalis::fsi
