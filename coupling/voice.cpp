#include "coupling/voice.hpp"

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
acoustic::FarFieldSettings far_field(const Scene& scene, const Case& config, const acoustic::AcousticSettings& settings,
                                     std::vector<std::int32_t> has_source) {
  const mesh::Mesh& mesh = scene.acoustic->mesh;
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

}  // namespace

Voice::Voice(Scene& scene, const Case& config, const acoustic::AcousticSettings& settings)
    : scene_(scene),
      settings_(settings),
      step_(config.time.step),
      moves_(config.flow && std::any_of(config.regions.begin(), config.regions.end(),
                                        [](const Region& region) { return region.kind == RegionKind::solid; })),
      analogy_(make_analogy(settings.analogy, settings.density, settings.speed_of_sound)),
      air_(make_air(scene, {})),
      solver_(air_->mesh(), settings),
      microphones_(air_->mesh(), config.microphones, far_field(scene, config, settings, air_->cell_has_flow)) {
  microphones_.require_inside();
  require_undamped(air_->mesh(), settings_, microphones_);
}

std::string Voice::integrator_words() const { return acoustic::words(solver_.choice(step_, moves_)); }

double Voice::fade(double time) const {
  if (time >= settings_.source_fade_in) return 1;
  return 0.5 * (1 - std::cos(std::numbers::pi * time / settings_.source_fade_in));
}

std::vector<double> Voice::flow_pressure(const std::vector<double>& of_flow_vertices) const {
  // A fluid cell is on the same rank in both meshes, so its vertices are, too.
  const transfer::StrippedMesh& acoustic = *air_->stripped;
  std::vector<double> result(acoustic.mesh.num_vertices(), 0.0);
  for (std::size_t v = 0; v < result.size(); ++v) {
    const std::int32_t there = scene_.flow->parent_to_vertex[acoustic.vertex_to_parent[v]];
    if (there >= 0) result[v] = of_flow_vertices[there];
  }
  return result;
}

acoustic::AdvanceReport Voice::follow(const FlowView& flow, const fem::Field& displacement_begin,
                                      const fem::Field& displacement_end) {
  AnalogySource there = analogy_->source(flow);
  for (double& value : there.begin.values) value *= fade(flow.time_begin);
  for (double& value : there.end.values) value *= fade(flow.time_end);
  fem::Load begin(solver_.space(), 1), end(solver_.space(), 1);
  air_->from_flow->carry(there.begin, begin);
  air_->from_flow->carry(there.end, end);

  const std::vector<double> from = moved_coordinates(*air_, solver_.space(), displacement_begin);
  const std::vector<double> to = moved_coordinates(*air_, solver_.space(), displacement_end);
  mesh::Mesh& mesh = air_->mesh();
  for (const acoustic::FarField& far : microphones_.far_fields()) far.require_still(mesh, to);
  const std::vector<double> first = flow_pressure(flow.pressure_begin), last = flow_pressure(flow.pressure_end);
  std::vector<double> between(first.size());
  const double start = solver_.state().time, dt = flow.time_end - flow.time_begin;
  // Microphones stand still and cells pass them: where they are counts at each sub-step.
  const auto listen = [&](double time) {
    const double part = (time - start) / dt;
    for (std::size_t i = 0; i < to.size(); ++i) mesh.coordinates[i] = (1 - part) * from[i] + part * to[i];
    microphones_.follow(mesh);
    for (std::size_t v = 0; v < first.size(); ++v) between[v] = (1 - part) * first[v] + part * last[v];
    const acoustic::FlowPressure heard = {between, air_->cell_has_flow};
    microphones_.sample(time, solver_.state().p, &heard);
  };
  const auto report = solver_.advance(dt, {from, to}, {.begin = &begin, .end = &end, .flux = {}}, listen);
  mesh.coordinates = to;
  return report;
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

void Voice::drop_caches() {
  solver_.drop_caches();
  microphones_.follow(air_->mesh(), true);
}

acoustic::AdvanceReport Voice::drive(double dt, const std::function<double(double)>& flux) {
  return solver_.advance(dt, {}, {.begin = nullptr, .end = nullptr, .flux = flux},
                         [this](double time) { microphones_.sample(time, solver_.state().p); });
}

}  // namespace vocalis::coupling
