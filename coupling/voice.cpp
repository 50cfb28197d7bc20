#include "coupling/voice.hpp"

#include <cmath>
#include <numbers>

namespace vocalis::coupling {

Voice::Voice(Scene& scene, const Case& config, const acoustic::AcousticSettings& settings)
    : scene_(scene),
      settings_(settings),
      analogy_(make_analogy(settings.analogy, settings.density, settings.speed_of_sound)),
      solver_(scene.acoustic->mesh, settings),
      microphones_(scene.acoustic->mesh, config.microphones),
      rest_coordinates_(scene.acoustic->mesh.coordinates) {
  microphones_.require_inside();
  if (scene.flow) {
    flow_to_acoustic_ = std::make_unique<transfer::SharedVertices>(
        transfer::SharedVertices::between(scene.parent, *scene.flow, *scene.acoustic));
  }
}

double Voice::fade(double time) const {
  if (time >= settings_.source_fade_in) return 1;
  return 0.5 * (1 - std::cos(std::numbers::pi * time / settings_.source_fade_in));
}

std::vector<double> Voice::moved_coordinates(const fem::Field& displacement) const {
  fem::Field here(solver_.space(), displacement.components);
  flow_to_acoustic_->carry(displacement, here);
  for (std::size_t i = 0; i < here.values.size(); ++i) here.values[i] += rest_coordinates_[i];
  return std::move(here.values);
}

acoustic::AdvanceReport Voice::follow(const FlowView& flow, const fem::Field& displacement_begin,
                                      const fem::Field& displacement_end) {
  AnalogySource there = analogy_->source(flow);
  for (double& value : there.begin.values) value *= fade(flow.time_begin);
  for (double& value : there.end.values) value *= fade(flow.time_end);
  fem::Load begin(solver_.space(), 1), end(solver_.space(), 1);
  flow_to_acoustic_->carry(there.begin, begin);
  flow_to_acoustic_->carry(there.end, end);

  const std::vector<double> from = moved_coordinates(displacement_begin), to = moved_coordinates(displacement_end);
  mesh::Mesh& mesh = scene_.acoustic->mesh;
  const double start = solver_.state().time, dt = flow.time_end - flow.time_begin;
  // Microphones stand still and cells pass them: where they are counts at each sub-step.
  const auto listen = [&](double time) {
    const double part = (time - start) / dt;
    for (std::size_t i = 0; i < to.size(); ++i) mesh.coordinates[i] = (1 - part) * from[i] + part * to[i];
    microphones_.follow(mesh);
    microphones_.sample(time, solver_.state().p);
  };
  const auto report = solver_.advance(dt, {from, to}, {.begin = &begin, .end = &end, .flux = {}}, listen);
  mesh.coordinates = to;
  return report;
}

void Voice::move_to(const fem::Field& displacement) {
  scene_.acoustic->mesh.coordinates = moved_coordinates(displacement);
}

void Voice::drop_caches() {
  solver_.drop_caches();
  microphones_.follow(scene_.acoustic->mesh, true);
}

acoustic::AdvanceReport Voice::drive(double dt, const std::function<double(double)>& flux) {
  return solver_.advance(dt, {}, {.begin = nullptr, .end = nullptr, .flux = flux},
                         [this](double time) { microphones_.sample(time, solver_.state().p); });
}

}  // namespace vocalis::coupling
