#include "coupling/voice/voice.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "acoustic_solver/layer_profile.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"

namespace vocalis::coupling {

namespace {

/// Sound is made in the flow, or along the group where a prescribed source enters. Time goes in whole sub-steps.
acoustic::FarFieldSettings far_field(const mesh::Mesh& mesh, const Case& config,
                                     const acoustic::AcousticSettings& settings, std::vector<std::int32_t> has_source) {
  if (config.source) {
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, config.source->group)) has_source[facet.cell] = 1;
  }
  const double step = config.time.step > 0 ? config.time.step : settings.step;
  const double interval = step / std::ceil(step / settings.step * (1 - 1e-9));
  return {settings.speed_of_sound, interval, std::move(has_source)};
}

/// What leaves a layer is no more what came in. Collective.
void require_undamped(const mesh::Mesh& mesh, const acoustic::AcousticSettings& settings,
                      const acoustic::Microphones& microphones) {
  if (microphones.far_fields().empty() || settings.layers.empty()) return;
  const std::vector<acoustic::LayerSide> sides = acoustic::layer_sides(mesh, settings);
  double damping = 0;
  for (const acoustic::FarField& far : microphones.far_fields()) {
    const auto points = far.skin_points();
    for (std::size_t i = 0; i < points.size(); ++i) {
      damping = std::max(damping, acoustic::damping_up_to(sides, static_cast<int>(i % 3), points[i]));
    }
  }
  if (base::largest(mesh.comm, damping) == 0) return;
  throw base::UserError("the surface of a far-field microphone lies before the layers that absorb sound",
                        "cells along it that are damped", "name a surface further in");
}

/// Weight of the source at the flow's vertices at rest: 1 within the window, falling as a cosine to 0 over its width.
std::vector<double> source_window(const Scene& scene, const acoustic::AnalogySettings& settings) {
  if (!scene.flow || settings.window_radius == 0) return {};
  const mesh::Mesh& mesh = scene.flow->mesh;
  std::vector<double> weights;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    double square = 0;
    for (int k = 0; k < mesh.dimension; ++k) square += std::pow(mesh.point(v)[k] - settings.window_centre[k], 2);
    const double beyond = std::sqrt(square) - settings.window_radius;
    const double part = settings.window_width > 0 ? beyond / settings.window_width : (beyond > 0 ? 1 : 0);
    weights.push_back(0.5 * (1 + std::cos(std::numbers::pi * std::clamp(part, 0.0, 1.0))));
  }
  return weights;
}

AnalogyMedium medium_of(const Scene& scene, const Case& config, const acoustic::AcousticSettings& settings) {
  const Fluid& fluid = config.fluid;
  const double kinematic_viscosity = fluid.viscosity > 0 ? fluid.viscosity / fluid.density : 0;
  return {settings.density, settings.speed_of_sound, source_window(scene, settings.analogy), kinematic_viscosity};
}

/// A boundary that lies elsewhere would have no effect. Collective.
void require_boundaries(const mesh::Mesh& air, const acoustic::AcousticSettings& settings) {
  for (const acoustic::AcousticBoundary& boundary : settings.boundaries) {
    const auto count = static_cast<std::int64_t>(mesh::exterior_facets_of_group(air, boundary.group).size());
    if (base::sum(air.comm, count) > 0) continue;
    throw base::UserError("a boundary of [[acoustic]] \"" + settings.name + "\" must lie where its air ends",
                          "\"" + boundary.group + "\", which has no facet there",
                          "name another group, or leave this boundary out");
  }
}

/// Histories of p_a alone can be carried over to a mesh with other cells.
void require_rebuildable(const acoustic::AcousticSettings& settings, Unknown unknown) {
  if (settings.contact_cells == acoustic::ContactCells::keep || unknown == Unknown::acoustic_pressure) return;
  throw base::UserError("contact_cells = \"strip\" needs an analogy for p_a: pressure_rate, pcwe or none",
                        "analogy = \"" + settings.analogy.name + "\", which solves for the total pressure",
                        "write contact_cells = \"keep\"");
}

/// Whether the voice's air moves where the flow's mesh does.
bool may_follow(const Case& config, const std::string& name) {
  const auto own = config.acoustic_meshes.find(name);
  return own == config.acoustic_meshes.end() || own->second.follows_flow;
}

}  // namespace

Voice::Voice(Scene& scene, const Case& config, const acoustic::AcousticSettings& settings, const Voice* beside)
    : scene_(scene),
      settings_(settings),
      step_(config.time.step),
      moves_(config.may_move() && may_follow(config, settings.name)),
      analogy_(make_analogy(settings.analogy, medium_of(scene, config, settings))),
      air_(beside && beside->air_->is_separate ? beside->air_ : make_air(scene, config, settings.name)),
      solver_(beside ? acoustic::AcousticSolver::beside(beside->solver_, settings)
                     : acoustic::AcousticSolver(air_->mesh(), settings)),
      microphones_(air_->mesh(), config.microphones, far_field(air_->mesh(), config, settings, air_->cell_has_flow)) {
  require_rebuildable(settings, analogy_->unknown());
  require_boundaries(air_->mesh(), settings);
  microphones_.require_inside();
  require_undamped(air_->mesh(), settings_, microphones_);
}

std::string Voice::integrator_words() const { return acoustic::words(solver_.choice(step_, moves_)); }

double Voice::fade(double time) const {
  const double rise = settings_.analogy.fade_in;
  if (time >= rise) return 1;
  return 0.5 * (1 - std::cos(std::numbers::pi * time / rise));
}

Voice::Drive Voice::carry(const FlowView& all_of_flow, const fem::Field& displacement_begin,
                          const fem::Field& displacement_end) {
  const auto seen = air_->bridge ? air_->bridge->with_ends(all_of_flow) : std::optional<FlowView>();
  const FlowView& flow = seen ? *seen : all_of_flow;
  AnalogySource there;
  std::vector<double> convection, head_begin, head_end;
  {
    const auto scope = timers_.scope("analogy");
    analogy_->follow(flow);
    there = analogy_->source(flow);
    for (double& value : there.begin.values) value *= fade(flow.time_begin);
    for (double& value : there.end.values) value *= fade(flow.time_end);
    convection = analogy_->convection(flow);
    head_begin = analogy_->head(flow, flow.velocity_begin);
    head_end = analogy_->head(flow, flow.velocity_end);
  }
  const auto scope = timers_.scope("transfer");
  Drive drive;
  drive.begin = drive.end = fem::Load(solver_.space(), 1);
  coupling::carry(*air_, there.begin, drive.begin);
  coupling::carry(*air_, there.end, drive.end);
  drive.from = moved_coordinates(*air_, solver_.space(), displacement_begin);
  drive.to = moved_coordinates(*air_, solver_.space(), displacement_end);
  drive.flow_begin = values_of_flow(scene_, *air_, flow.pressure_begin, 1);
  drive.flow_end = values_of_flow(scene_, *air_, flow.pressure_end, 1);
  if (analogy_->unknown() == Unknown::enthalpy) {
    drive.head_begin = values_of_flow(scene_, *air_, head_begin, 1);
    drive.head_end = values_of_flow(scene_, *air_, head_end, 1);
  }
  if (analogy_->unknown() != Unknown::acoustic_pressure) {
    const double factor = fade(0.5 * (flow.time_begin + flow.time_end)) / (flow.time_end - flow.time_begin);
    drive.released = drive.flow_end;
    for (std::size_t v = 0; v < drive.released.size(); ++v) {
      if (!drive.head_end.empty()) drive.released[v] += drive.head_end[v] - drive.head_begin[v];
      drive.released[v] = factor * (drive.released[v] - drive.flow_begin[v]);
    }
  }
  // A rank without vertices of the flow has an empty U, too.
  if (base::largest(scene_.parent.comm, static_cast<std::int32_t>(!convection.empty())) == 0) return drive;
  if (air_->bridge) {
    drive.convection = air_->bridge->values(convection, scene_.parent.dimension);
  } else {
    fem::Field flow_velocity(*flow.space, scene_.parent.dimension), here(solver_.space(), scene_.parent.dimension);
    flow_velocity.values = std::move(convection);
    air_->from_flow->carry(flow_velocity, here);
    drive.convection = std::move(here.values);
  }
  return drive;
}

void Voice::split(const Drive& drive, double part) {
  const acoustic::State& state = solver_.state();
  flow_.resize(drive.flow_begin.size());
  for (std::size_t v = 0; v < flow_.size(); ++v) {
    flow_[v] = (1 - part) * drive.flow_begin[v] + part * drive.flow_end[v];
  }
  if (analogy_->unknown() == Unknown::acoustic_pressure) return;
  sound_.resize(state.psi.size());
  for (std::size_t v = 0; v < sound_.size(); ++v) sound_[v] = settings_.density * state.psi[v] - flow_[v];
  for (std::size_t v = 0; v < drive.head_begin.size(); ++v) {
    sound_[v] -= (1 - part) * drive.head_begin[v] + part * drive.head_end[v];
  }
}

acoustic::AdvanceReport Voice::follow(const FlowView& flow, const fem::Field& displacement_begin,
                                      const fem::Field& displacement_end) {
  const Drive drive = carry(flow, displacement_begin, displacement_end);
  const auto scope = timers_.scope("acoustic");
  if (!keeps_its_cells(*air_, drive.to)) {
    acoustic::AdvanceReport failure;
    failure.converged = false;
    failure.reason = "a cell of the mesh of [[acoustic]] \"" + settings_.name +
                     "\" turned over as it followed the flow's: make its cells smaller there, or let it stand still";
    return failure;
  }
  mesh::Mesh& mesh = air_->mesh();
  for (const acoustic::FarField& far : microphones_.far_fields()) far.require_still(mesh, drive.to);
  const double start = solver_.state().time, dt = flow.time_end - flow.time_begin;
  // Microphones stand still and cells pass them: where they are counts at each sub-step.
  const auto listen = [&](double time) {
    const double part = (time - start) / dt;
    if (air_->moves()) {
      for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) {
        mesh.coordinates[i] = (1 - part) * drive.from[i] + part * drive.to[i];
      }
      microphones_.follow(mesh);
    }
    split(drive, part);
    const acoustic::FlowPressure heard = {flow_, air_->cell_has_flow};
    microphones_.sample(time, sound_.empty() ? solver_.state().p : sound_, &heard);
  };
  const acoustic::Motion motion = {.begin = drive.from, .end = drive.to, .convection = drive.convection};
  const acoustic::Source source = {.begin = &drive.begin, .end = &drive.end, .flux = {}, .released = drive.released};
  const auto report = solver_.advance(dt, motion, source, listen);
  mesh.coordinates = drive.to;
  return report;
}

acoustic::AdvanceReport Voice::follow(const FlowStep& step) {
  {
    const auto scope = timers_.scope("transfer");
    follow_contact(step.in_contact, step.displacement_begin);
  }
  return follow(step.view, step.displacement_begin, step.displacement_end);
}

fem::Field Voice::pressure() const {
  fem::Field result = solver_.pressure();
  if (!sound_.empty()) result.values = sound_;
  return result;
}

void Voice::move_to(const fem::Field& displacement) {
  air_->mesh().coordinates = moved_coordinates(*air_, solver_.space(), displacement);
}

void Voice::follow_contact(std::span<const char> in_contact, const fem::Field& displacement) {
  if (settings_.contact_cells == acoustic::ContactCells::keep) return;
  std::vector<char> stripped(in_contact.begin(), in_contact.end());
  stripped.resize(scene_.flow->mesh.num_cells(), 0);
  stripped_.resize(stripped.size(), 0);
  const auto changed = static_cast<std::int32_t>(stripped != stripped_);
  if (base::largest(scene_.parent.comm, changed) == 0) return;
  stripped_ = std::move(stripped);
  const auto before = std::exchange(air_, make_air(scene_, stripped_));
  air_->mesh().coordinates = moved_coordinates(*air_, fem::lagrange(air_->mesh(), 1), displacement);
  const acoustic::Adoption adoption = solver_.adopt(scene_.parent, *before->stripped, *air_->stripped);
  microphones_.adopt(air_->mesh(), vertices_there(*before, *air_));
  ++rebuilds_.count;
  rebuilds_.energy_lost += adoption.energy_before - adoption.energy_after;
}

void Voice::carry_to_parent(const fem::Field& from, fem::Field& to, double otherwise) const {
  if (!air_->is_separate) {
    transfer::SharedVertices::to_parent(scene_.parent, *air_->stripped).carry(from, to, otherwise);
    return;
  }
  mesh::Mesh& mesh = air_->mesh();
  const std::vector<double> here = std::exchange(mesh.coordinates, air_->rest_coordinates);
  const transfer::PointInterpolation at_parent(mesh, scene_.parent.coordinates);
  mesh.coordinates = here;
  at_parent.evaluate(from, to.values);
  const std::vector<std::int32_t> is_held = at_parent.is_held();
  for (std::size_t v = 0; v < is_held.size(); ++v) {
    if (!is_held[v]) to.values[v] = otherwise;
  }
}

void Voice::drop_caches() {
  solver_.drop_caches();
  microphones_.follow(air_->mesh(), true);
}

acoustic::AdvanceReport Voice::drive(double dt, const std::function<double(double)>& flux) {
  const auto scope = timers_.scope("acoustic");
  return solver_.advance(dt, {}, {.begin = nullptr, .end = nullptr, .flux = flux},
                         [this](double time) { microphones_.sample(time, solver_.state().p); });
}

}  // namespace vocalis::coupling
