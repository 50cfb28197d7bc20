#include "fsi_solver/stage_fields.hpp"

#include <algorithm>

namespace vocalis::fsi {

StageFields::StageFields(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
                         const Prescribed& prescribed, MeshMotion* motion)
    : continuum_(continuum),
      settings_(settings),
      conditions_(conditions),
      prescribed_(prescribed),
      motion_(motion),
      moves_(continuum.has_solid || prescribed.mesh_displacement),
      has_forces_(prescribed.fluid_force || prescribed.solid_force || settings.gravity != std::array<double, 3>{}) {
  const int d = continuum.mesh->dimension;
  const fem::Space& velocities = continuum.velocity_space;
  const fem::Space& pressures = continuum.pressure_space;
  layout_ = la::SystemLayout(continuum.mesh->comm, {{&velocities.dofs, d}, {&pressures.dofs, 1}, {&pressures.dofs, d}});
  velocity_ = displacement_ = fem::Field(velocities, d);
  pressure_ = fem::Field(pressures, 1);
  gradient_ = fem::Field(pressures, d);
  stage_velocity_ = stage_rate_ = velocity_.values;
  if (moves_) stage_displacement_ = mesh_velocity_ = velocity_.values;
  if (has_forces_) fluid_force_ = solid_force_ = velocity_.values;
}

void StageFields::begin_step(const State& state, const Stage& stage, Vec unknowns) {
  state_ = &state;
  stage_ = stage;
  fem::Field guess = state.velocity;
  const double ratio = state.last_dt > 0 ? stage.dt / state.last_dt : 0;
  for (std::size_t i = 0; i < guess.values.size(); ++i) {
    guess.values[i] += ratio * (guess.values[i] - state.velocity_before.values[i]);
  }
  impose(conditions_, continuum_, prescribed_, end_coordinates(), state.time + stage.dt, guess);
  const la::OwnedValues values(unknowns);
  layout_.copy_owned_to_system(0, guess.values, values.data());
  layout_.copy_owned_to_system(1, state.pressure.values, values.data());
}

/// Where the vertices are at the end of the step if their motion is prescribed; else the reference, (vertices,
/// dimension) [m].
std::vector<double> StageFields::end_coordinates() const {
  const mesh::Mesh& mesh = *continuum_.mesh;
  const int d = mesh.dimension;
  std::vector<double> coordinates = mesh.coordinates;
  for (std::int32_t v = 0; v < mesh.num_vertices() && prescribed_.mesh_displacement; ++v) {
    std::array<double, 3> point = {0, 0, 0};
    std::copy_n(mesh.point(v), d, point.begin());
    const auto displacement = prescribed_.mesh_displacement(point, state_->time + stage_.dt);
    for (int k = 0; k < d; ++k) coordinates[static_cast<std::size_t>(v) * d + k] += displacement[k];
  }
  return coordinates;
}

void StageFields::follow(Vec unknowns) {
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

void StageFields::find_forces() {
  if (!has_forces_) return;
  const mesh::Mesh& mesh = *continuum_.mesh;
  const int d = mesh.dimension;
  const double time = stage_time();
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

template <int D>
void StageFields::gather(std::int32_t cell, CellInput<D>& in) const {
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

template void StageFields::gather<2>(std::int32_t, CellInput<2>&) const;
template void StageFields::gather<3>(std::int32_t, CellInput<3>&) const;

}  // namespace vocalis::fsi
