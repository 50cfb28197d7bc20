#include "fsi_solver/solution/stage_fields.hpp"

#include <algorithm>
#include <cmath>

#include "fsi_solver/cells/curvature.hpp"

namespace vocalis::fsi {

namespace {

/// The offset of the mesh where cells opened leaves the worst cell this part of the quality that it has without.
constexpr double kept_quality = 0.1;
/// An offset of which less could be kept is dropped.
constexpr double smallest_offset = 1.0 / 16;

}  // namespace

StageFields::StageFields(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
                         const Prescribed& prescribed, MeshFollower* motion)
    : continuum_(continuum),
      settings_(settings),
      conditions_(conditions),
      prescribed_(prescribed),
      motion_(motion),
      moves_(continuum.has_solid || prescribed.mesh_displacement),
      has_forces_(prescribed.fluid_force || prescribed.solid_force) {
  const int d = continuum.mesh->dimension;
  const fem::Space& velocities = continuum.velocity_space;
  const fem::Space& pressures = continuum.pressure_space;
  std::vector<la::SystemLayout::Part> parts = {{&velocities.dofs, d}, {&pressures.dofs, 1}};
  if (velocities.degree == 1) parts.push_back({&pressures.dofs, d});
  layout_ = la::SystemLayout(continuum.mesh->comm, parts);
  velocity_ = displacement_ = fem::Field(velocities, d);
  mesh_displacement_ = fem::Field(continuum.vertex_space, d);
  pressure_ = fem::Field(pressures, 1);
  gradient_ = fem::Field(pressures, d);
  stage_velocity_ = stage_rate_ = velocity_.values;
  if (moves_) material_ = grid_ = grid_velocity_ = velocity_.values;
  if (has_forces_) fluid_force_ = solid_force_ = velocity_.values;
}

void StageFields::begin_step(const State& state, const Stage& stage, Start start, Vec unknowns) {
  state_ = &state;
  stage_ = stage;
  offset_left_ = settings_.mesh_recovery > 0 ? std::exp(-stage.dt / settings_.mesh_recovery) : 0;
  velocity_ = state.velocity;
  const bool extrapolates = start == Start::extrapolated && state.last_dt > 0;
  const double ratio = extrapolates ? stage.dt / state.last_dt : 0;
  for (std::size_t i = 0; i < velocity_.values.size(); ++i) {
    velocity_.values[i] += ratio * (velocity_.values[i] - state.velocity_before.values[i]);
  }
  impose_at_end(velocity_);
  {
    const la::OwnedValues values(unknowns);
    layout_.copy_owned_to_system(0, velocity_.values, values.data());
    layout_.copy_owned_to_system(1, state.pressure.values, values.data());
  }
  if (motion_ && settings_.smoother == Smoother::nonlinear)
    motion_->begin_step(at_vertices(continuum_, state.displacement), state.mesh_offset);
  if (!moves_ || settings_.geometry == Geometry::implicit) return;
  for (std::size_t i = 0; i < velocity_.values.size(); ++i) {
    stage_velocity_[i] = stage_.at_stage(velocity_.values[i], state.velocity.values[i]);
  }
  move_solids();
  move_fluid_mesh();
  set_stage_geometry();
}

void StageFields::predict(Vec unknowns) {
  const State& now = *state_;
  if (now.last_dt <= 0) return;
  const double ratio = stage_.dt / now.last_dt;
  for (std::size_t i = 0; i < velocity_.values.size(); ++i) {
    const double difference = now.velocity.values[i] - now.velocity_before.values[i];
    velocity_.values[i] =
        now.velocity.values[i] + (1 + ratio) * stage_.dt * now.acceleration.values[i] - ratio * ratio * difference;
  }
  impose_at_end(velocity_);
  const la::OwnedValues values(unknowns);
  layout_.copy_owned_to_system(0, velocity_.values, values.data());
}

void StageFields::impose_at_end(fem::Field& velocity) const {
  impose(conditions_, continuum_, prescribed_, end_coordinates(), state_->time + stage_.dt, velocity);
}

/// Where the velocity's dofs are at the end of the step if their motion is prescribed; else the reference, (dofs,
/// dimension) [m].
std::vector<double> StageFields::end_coordinates() const {
  const int d = continuum_.mesh->dimension;
  std::vector<double> coordinates = continuum_.reference_points;
  for (std::size_t first = 0; first < coordinates.size() && prescribed_.mesh_displacement; first += d) {
    std::array<double, 3> point = {0, 0, 0};
    std::copy_n(coordinates.data() + first, d, point.begin());
    const auto displacement = prescribed_.mesh_displacement(point, state_->time + stage_.dt);
    for (int k = 0; k < d; ++k) coordinates[first + k] += displacement[k];
  }
  return coordinates;
}

void StageFields::follow(Vec unknowns) {
  {
    const la::ReadValues values(unknowns);
    layout_.copy_owned(0, values.data(), velocity_.values);
    layout_.copy_owned(1, values.data(), pressure_.values);
    if (continuum_.velocity_space.degree == 1) layout_.copy_owned(2, values.data(), gradient_.values);
  }
  velocity_.copy_to_ghosts();
  pressure_.copy_to_ghosts();
  if (continuum_.velocity_space.degree == 1) gradient_.copy_to_ghosts();
  const State& now = *state_;
  for (std::size_t i = 0; i < velocity_.values.size(); ++i) {
    stage_velocity_[i] = stage_.at_stage(velocity_.values[i], now.velocity.values[i]);
    stage_rate_[i] = stage_.rate_of(velocity_.values[i], now.velocity.values[i], now.velocity_before.values[i]);
  }
  if (!moves_) return;
  move_solids();
  if (settings_.geometry == Geometry::implicit) {
    move_fluid_mesh();
    set_stage_geometry();
  }
  for (std::size_t i = 0; i < material_.size(); ++i) {
    material_[i] = stage_.at_stage(displacement_.values[i], now.displacement.values[i]);
  }
}

/// The solids' displacement at the end follows from their velocity.
void StageFields::move_solids() {
  const State& now = *state_;
  const int d = continuum_.mesh->dimension;
  for (std::size_t dof = 0; dof < continuum_.dof_solid.size(); ++dof) {
    if (continuum_.dof_solid[dof] < 0) continue;
    for (std::size_t i = dof * d; i < (dof + 1) * d; ++i) {
      displacement_.values[i] =
          stage_.end_displacement(stage_velocity_[i], now.displacement.values[i], now.displacement_before.values[i]);
    }
  }
}

/// What is left of the mesh's offset where cells opened. Walls that move on, and a smoother whose mesh buckles, may
/// turn cells over by it: then less of it is left, for the rest of the step.
void StageFields::add_mesh_offset() {
  const fem::Field smooth = mesh_displacement_;
  const double quality = smallest_fluid_quality(continuum_, smooth);
  const double enough = quality > 0 ? kept_quality * quality : quality;
  while (offset_left_ > 0) {
    for (std::size_t i = 0; i < smooth.values.size(); ++i) {
      mesh_displacement_.values[i] = smooth.values[i] + offset_left_ * state_->mesh_offset[i];
    }
    if (smallest_fluid_quality(continuum_, mesh_displacement_) >= enough) return;
    offset_left_ = offset_left_ > smallest_offset ? offset_left_ / 2 : 0;
  }
  mesh_displacement_ = smooth;
}

/// The fluid's mesh at the end: its vertices follow the solids or a prescribed motion, and the middles of its edges lie
/// between, but for those on solids.
void StageFields::move_fluid_mesh() {
  const mesh::Mesh& mesh = *continuum_.mesh;
  const fem::Space& space = continuum_.velocity_space;
  const int d = mesh.dimension;
  if (!prescribed_.mesh_displacement) {
    if (!motion_) return;
    for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
      std::copy_n(displacement_.at(continuum_.vertex_to_dof[v]), d, mesh_displacement_.at(v));
    }
    motion_->extend(mesh_displacement_);
    if (continuum_.contact >= 0) add_mesh_offset();
  }
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    if (continuum_.dof_solid[dof] >= 0) continue;
    double* value = displacement_.at(dof);
    if (prescribed_.mesh_displacement) {
      std::array<double, 3> point = {0, 0, 0};
      std::copy_n(continuum_.reference_points.data() + static_cast<std::size_t>(dof) * d, d, point.begin());
      const auto given = prescribed_.mesh_displacement(point, state_->time + stage_.dt);
      std::copy_n(given.begin(), d, value);
    } else if (space.dof_vertex[dof] >= 0) {
      std::copy_n(mesh_displacement_.at(space.dof_vertex[dof]), d, value);
    } else {
      const std::int32_t* ends = mesh.edge_vertices.data() + 2 * static_cast<std::size_t>(space.dof_edge[dof]);
      for (int k = 0; k < d; ++k) {
        value[k] = 0.5 * (mesh_displacement_.at(ends[0])[k] + mesh_displacement_.at(ends[1])[k]);
      }
    }
  }
}

void StageFields::set_stage_geometry() {
  const State& now = *state_;
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const double end = displacement_.values[i];
    grid_[i] = stage_.at_stage(end, now.displacement.values[i]);
    grid_velocity_[i] = stage_.rate_of(end, now.displacement.values[i], now.displacement_before.values[i]);
  }
}

void StageFields::find_forces() {
  if (!has_forces_) return;
  const int d = continuum_.mesh->dimension;
  const double time = stage_time();
  for (std::size_t first = 0; first < fluid_force_.size(); first += d) {
    std::array<double, 3> reference = {0, 0, 0};
    std::copy_n(continuum_.reference_points.data() + first, d, reference.begin());
    std::array<double, 3> moved = reference, fluid = {0, 0, 0}, solid = {0, 0, 0};
    for (int k = 0; k < d && moves_; ++k) moved[k] += grid_[first + k];
    if (prescribed_.fluid_force) fluid = prescribed_.fluid_force(moved, time);
    if (prescribed_.solid_force) solid = prescribed_.solid_force(reference, time);
    std::copy_n(fluid.begin(), d, fluid_force_.begin() + static_cast<std::ptrdiff_t>(first));
    std::copy_n(solid.begin(), d, solid_force_.begin() + static_cast<std::ptrdiff_t>(first));
  }
}

/// A contact cell's reference is where it closed, in the shape that the fluid had: what it has moved since stays what
/// it is. Its normal, where one counts.
template <int D, int Degree>
void StageFields::refer_to_closing(const CellBatches::Batch& batch, CellInput<D, Degree>& in) const {
  constexpr int nodes = CellInput<D, Degree>::nodes;
  for (int lane = 0; lane < lane_count; ++lane) {
    const double* closing = continuum_.closing_points.data() + static_cast<std::size_t>(batch.cell[lane]) * nodes * D;
    for (int a = 0; a < nodes; ++a) {
      for (int k = 0; k < D; ++k) {
        in.displacement[a][k][lane] += in.position[a][k][lane] - closing[a * D + k];
        in.position[a][k][lane] = closing[a * D + k];
      }
    }
    if (continuum_.contact_normals.empty()) continue;
    const double* normal = continuum_.contact_normals.data() + static_cast<std::size_t>(batch.cell[lane]) * D;
    for (int k = 0; k < D; ++k) in.normal[k][lane] = normal[k];
  }
  limit_bow<D, Degree>(in.position);
}

template <int D, int Degree>
void StageFields::gather(const CellBatches& batches, std::size_t batch, CellInput<D, Degree>& in) const {
  const std::int32_t solid = batches.batches[batch].solid;
  const bool is_fluid = solid < 0;
  in.largest_rate = stage_.rate;
  in.density = is_fluid ? settings_.density : continuum_.solids[solid].density;
  const std::vector<double>& force = is_fluid ? fluid_force_ : solid_force_;
  const std::int32_t* dofs = batches.velocity_dofs_of(batch);
  for (int a = 0; a < CellInput<D, Degree>::nodes; ++a) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::size_t first = static_cast<std::size_t>(dofs[a * lane_count + lane]) * D;
      for (int k = 0; k < D; ++k) {
        const std::size_t i = first + k;
        in.position[a][k][lane] = continuum_.reference_points[i] + (is_fluid && moves_ ? grid_[i] : 0.0);
        in.velocity[a][k][lane] = stage_velocity_[i];
        in.slip[a][k][lane] = stage_velocity_[i] - (moves_ ? grid_velocity_[i] : 0.0);
        in.inertia[a][k][lane] = in.density * (stage_rate_[i] - settings_.gravity[k]) - (has_forces_ ? force[i] : 0.0);
        if (!is_fluid) in.displacement[a][k][lane] = material_[i];
      }
    }
  }
  if (is_fluid && moves_) limit_bow<D, Degree>(in.position);
  if (!is_fluid && solid == continuum_.contact) refer_to_closing(batches.batches[batch], in);
  const std::int32_t* pressures = batches.pressure_dofs_of(batch);
  for (int b = 0; b <= D; ++b) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::int32_t dof = pressures[b * lane_count + lane];
      in.pressure[b][lane] = dof < 0 ? 0.0 : pressure_.values[dof];
      if constexpr (Element<D, Degree>::is_stabilised) {
        for (int k = 0; k < D; ++k) in.gradient[b][k][lane] = dof < 0 ? 0.0 : gradient_.at(dof)[k];
      }
    }
  }
}

#define VOCALIS_INSTANTIATE(D, Degree) \
  template void StageFields::gather<D, Degree>(const CellBatches&, std::size_t, CellInput<D, Degree>&) const;
VOCALIS_INSTANTIATE(2, 1)
VOCALIS_INSTANTIATE(2, 2)
VOCALIS_INSTANTIATE(3, 1)
VOCALIS_INSTANTIATE(3, 2)
#undef VOCALIS_INSTANTIATE

}  // namespace vocalis::fsi
