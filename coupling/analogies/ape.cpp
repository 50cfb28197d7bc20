#include "coupling/analogies/ape.hpp"

#include <utility>

namespace vocalis::coupling {

AcousticPerturbation::AcousticPerturbation(const acoustic::AnalogySettings& settings, AnalogyMedium medium)
    : medium_(std::move(medium)),
      convects_(settings.convection),
      mean_velocity_(settings.mean_time),
      mean_load_(settings.mean_time) {}

void AcousticPerturbation::follow(const FlowView& flow) {
  const std::vector<double> velocity = middle_velocity(flow);
  const double dt = flow.time_end - flow.time_begin;
  fem::Load load(*flow.space, 1);
  add_forces(flow, medium_, CarriedMomentum::lamb, velocity, middle_of_edges(flow), load);
  mean_velocity_.follow(velocity, dt);
  mean_load_.follow(load.values, dt);
}

AnalogySource AcousticPerturbation::source(const FlowView& flow) const {
  AnalogySource result = force_source(flow, medium_, CarriedMomentum::lamb);
  for (fem::Load* load : {&result.begin, &result.end}) {
    for (std::size_t v = 0; v < load->values.size(); ++v) load->values[v] -= mean_load_.mean()[v];
  }
  return result;
}

std::vector<double> AcousticPerturbation::convection(const FlowView&) const {
  return convects_ ? mean_velocity_.mean() : std::vector<double>();
}

std::vector<double> AcousticPerturbation::head(const FlowView& flow, const std::vector<double>& velocity) const {
  const std::size_t d = flow.space->mesh->dimension;
  const std::vector<double>& mean = mean_velocity_.mean();
  std::vector<double> result(velocity.size() / d, 0.0);
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    const double weight = medium_.window.empty() ? 1 : medium_.window[i / d];
    result[i / d] += weight * medium_.density * mean[i] * (velocity[i] - mean[i]);
  }
  return result;
}

std::vector<std::vector<double>*> AcousticPerturbation::memory() {
  auto result = mean_velocity_.memory();
  for (auto* values : mean_load_.memory()) result.push_back(values);
  return result;
}

}  // namespace vocalis::coupling
