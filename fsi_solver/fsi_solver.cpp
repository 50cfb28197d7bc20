#include "fsi_solver/fsi_solver.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "fsi_solver/capture.hpp"
#include "fsi_solver/solution/local_error.hpp"
#include "fsi_solver/solution/newton.hpp"

namespace vocalis::fsi {

struct FsiSolver::Inside {
  Inside(const mesh::Mesh& mesh, const FlowSettings& flow, const TimeSettings& times, Prescribed functions)
      : settings(flow),
        time_settings(times),
        prescribed(std::move(functions)),
        continuum(make_continuum(mesh, settings)),
        conditions(make_conditions(continuum, settings)) {
    if (continuum.has_fluid && continuum.has_solid && !prescribed.mesh_displacement) {
      motion = std::make_unique<MeshFollower>(continuum, conditions, settings, timers);
    }
    assembly = std::make_unique<Assembly>(continuum, settings, conditions, prescribed, motion.get());
    newton = std::make_unique<Newton>(*assembly, settings.newton_tolerance, settings.newton_iterations, timers);
    state.velocity = state.velocity_before = state.displacement = state.displacement_before = state.acceleration =
        fem::Field(continuum.velocity_space, mesh.dimension);
    state.pressure = fem::Field(continuum.pressure_space, 1);
    if (continuum.contact >= 0) {
      state.in_contact.assign(mesh.num_cells(), 0);
      state.closing_points = continuum.closing_points;
      state.contact_normals = continuum.contact_normals;
      state.mesh_offset.assign(mesh.coordinates.size(), 0.0);
    }
  }

  FlowSettings settings;
  TimeSettings time_settings;
  Prescribed prescribed;
  Continuum continuum;
  Conditions conditions;
  base::Timers timers;
  std::unique_ptr<MeshFollower> motion;
  std::unique_ptr<Assembly> assembly;
  std::unique_ptr<Newton> newton;
  State state;
  double tried_dt = 0;  ///< [s] of a step that may be accepted
};

namespace {

/// Of the velocity's dofs, (dofs, dimension) [m].
std::vector<double> moved_points(const Continuum& continuum, const fem::Field& displacement) {
  std::vector<double> points = continuum.reference_points;
  for (std::size_t i = 0; i < points.size(); ++i) points[i] += displacement.values[i];
  return points;
}

std::vector<double> moved_coordinates(const Continuum& continuum, const fem::Field& displacement) {
  std::vector<double> result = continuum.mesh->coordinates;
  const fem::Field moved = at_vertices(continuum, displacement);
  for (std::size_t i = 0; i < result.size(); ++i) result[i] += moved.values[i];
  return result;
}

}  // namespace

FsiSolver::FsiSolver(const mesh::Mesh& mesh, const FlowSettings& flow, const TimeSettings& time, Prescribed prescribed)
    : inside_(std::make_unique<Inside>(mesh, flow, time, std::move(prescribed))) {}

FsiSolver::~FsiSolver() = default;

StepReport FsiSolver::try_step(double dt) {
  assert(dt > 0);
  Inside& in = *inside_;
  const auto scope = in.timers.scope("flow.newton");
  const Stage stage = make_stage(in.time_settings, dt, in.state.last_dt);
  in.tried_dt = 0;
  const NewtonReport newton = in.newton->solve(in.state, stage);
  StepReport report;
  report.converged = newton.converged;
  report.newton_iterations = report.linear_iterations = newton.iterations;
  report.jacobians = newton.jacobians;
  report.residual = newton.residual;
  report.inverted = newton.inverted;
  report.reason = newton.reason;
  if (report.converged && in.continuum.has_solid) {
    report.smallest_quality =
        smallest_fluid_quality(in.continuum, at_vertices(in.continuum, in.assembly->fields().end_displacement()));
    if (!(report.smallest_quality > 0)) {
      report.converged = false;
      report.inverted = true;
      report.reason = "a cell would be inverted, " + in.assembly->worst_cell();
    }
  }
  if (report.converged && in.time_settings.tolerance > 0) {
    report.local_error =
        local_error(in.continuum, in.time_settings, stage, in.state, in.assembly->fields().end_velocity());
  }
  if (report.converged) in.tried_dt = dt;
  return report;
}

void FsiSolver::accept() {
  Inside& in = *inside_;
  assert(in.tried_dt > 0);
  in.state.velocity_before = std::exchange(in.state.velocity, in.assembly->fields().end_velocity());
  in.state.displacement_before = std::exchange(in.state.displacement, in.assembly->fields().end_displacement());
  in.state.pressure = in.assembly->fields().pressure();
  in.state.acceleration.values = in.assembly->fields().stage_rate();
  if (in.time_settings.tolerance > 0) {
    const std::array<double, 2> present = speeds(in.continuum, in.state.velocity);
    for (int i = 0; i < 2; ++i) in.state.largest_speeds[i] = std::max(in.state.largest_speeds[i], present[i]);
  }
  for (double& value : in.state.mesh_offset) value *= in.assembly->fields().offset_left();
  in.state.time += in.tried_dt;
  in.state.last_dt = std::exchange(in.tried_dt, 0);
}

double FsiSolver::set_contact(std::span<const char> in_contact, std::span<const double> normals) {
  Inside& in = *inside_;
  assert(in.continuum.contact >= 0 && in.motion);
  const std::vector<std::int32_t> solid_before = in.continuum.dof_solid;
  std::int32_t closes = 0;
  for (std::size_t cell = 0; cell < in_contact.size(); ++cell) closes |= in_contact[cell] && !in.state.in_contact[cell];
  vocalis::fsi::set_contact(in.continuum, in_contact, moved_points(in.continuum, in.state.displacement), normals);
  in.motion->rebuild();
  in.newton->drop_jacobian();
  in.state.in_contact.assign(in_contact.begin(), in_contact.end());
  in.state.closing_points = in.continuum.closing_points;
  in.state.contact_normals = in.continuum.contact_normals;
  fem::Field smooth = at_vertices(in.continuum, in.state.displacement);
  const std::vector<double> here = smooth.values;
  in.motion->begin_step(smooth, {});
  in.motion->extend(smooth);
  in.state.mesh_offset.resize(here.size());
  for (std::size_t i = 0; i < here.size(); ++i) in.state.mesh_offset[i] = here[i] - smooth.values[i];
  const double lost = capture(in.continuum, solid_before, in.settings.density, in.state);
  if (base::largest(in.continuum.mesh->comm, closes) > 0) in.state.last_dt = 0;
  return lost;
}

const State& FsiSolver::state() const { return inside_->state; }

void FsiSolver::set_state(const State& state) {
  inside_->state = state;
  // The given fields may stand on the spaces of another solver on the same mesh.
  for (fem::Field* field : {&inside_->state.velocity, &inside_->state.velocity_before, &inside_->state.displacement,
                            &inside_->state.displacement_before, &inside_->state.acceleration}) {
    field->space = &inside_->continuum.velocity_space;
  }
  inside_->state.pressure.space = &inside_->continuum.pressure_space;
  inside_->tried_dt = 0;
  if (inside_->continuum.contact >= 0) {
    vocalis::fsi::set_contact(inside_->continuum, state.in_contact,
                              moved_points(inside_->continuum, state.displacement), state.contact_normals);
    inside_->continuum.closing_points = state.closing_points;
    inside_->continuum.contact_normals = state.contact_normals;
    inside_->motion->rebuild();
  }
  drop_caches();
}

void FsiSolver::drop_caches() {
  inside_->newton->drop_jacobian();
  if (inside_->motion) inside_->motion->drop_factors();
}

const Continuum& FsiSolver::continuum() const { return inside_->continuum; }
const FlowSettings& FsiSolver::settings() const { return inside_->settings; }
const Assembly& FsiSolver::assembly() const { return *inside_->assembly; }
const fem::Space& FsiSolver::velocity_space() const { return inside_->continuum.velocity_space; }
const fem::Space& FsiSolver::pressure_space() const { return inside_->continuum.pressure_space; }
const base::Timers& FsiSolver::timers() const { return inside_->timers; }

std::int64_t FsiSolver::num_unknowns() const {
  const Continuum& continuum = inside_->continuum;
  return continuum.mesh->dimension * continuum.velocity_space.dofs.num_global +
         continuum.pressure_space.dofs.num_global;
}

std::vector<double> FsiSolver::current_coordinates() const {
  return moved_coordinates(inside_->continuum, inside_->state.displacement);
}

std::vector<double> FsiSolver::tried_coordinates() const {
  return moved_coordinates(inside_->continuum, inside_->assembly->fields().end_displacement());
}

fem::Field FsiSolver::velocity_at_vertices() const { return at_vertices(inside_->continuum, inside_->state.velocity); }

fem::Field FsiSolver::displacement_at_vertices() const {
  return at_vertices(inside_->continuum, inside_->state.displacement);
}

fem::Field FsiSolver::fluid_pressure() const {
  const fem::Space& pressures = inside_->continuum.pressure_space;
  // The owner of a pressure need not own its vertex: each gives its value once, the vertex's owner collects it.
  fem::Load given(inside_->continuum.vertex_space, 1);
  for (std::int32_t dof = 0; dof < pressures.dofs.num_owned; ++dof) {
    if (pressures.dof_label[dof] == 0) given.values[pressures.dof_vertex[dof]] = inside_->state.pressure.values[dof];
  }
  given.add_to_owners();
  fem::Field result(inside_->continuum.vertex_space, 1);
  result.values = given.values;
  result.copy_to_ghosts();
  return result;
}

double smallest_quality(const FsiSolver& solver) {
  return smallest_fluid_quality(solver.continuum(), at_vertices(solver.continuum(), solver.state().displacement));
}

}  // namespace vocalis::fsi
