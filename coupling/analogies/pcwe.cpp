#include "coupling/analogies/pcwe.hpp"

#include <utility>

namespace vocalis::coupling {

ConvectedPressureRate::ConvectedPressureRate(const acoustic::AnalogySettings& settings, AnalogyMedium medium)
    : medium_(std::move(medium)),
      convects_(settings.convection),
      by_mean_(settings.mean_flow),
      mean_(settings.mean_time) {}

void ConvectedPressureRate::follow(const FlowView& flow) {
  if (by_mean_) mean_.follow(middle_velocity(flow), flow.time_end - flow.time_begin);
}

std::vector<double> ConvectedPressureRate::flow_velocity(const FlowView& flow) const {
  return by_mean_ ? mean_.mean() : middle_velocity(flow);
}

AnalogySource ConvectedPressureRate::source(const FlowView& flow) const {
  std::vector<double> velocity = flow_velocity(flow);
  for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = flow.mesh_velocity[i] - velocity[i];
  return pressure_source(flow, medium_, velocity);
}

std::vector<double> ConvectedPressureRate::convection(const FlowView& flow) const {
  return convects_ ? flow_velocity(flow) : std::vector<double>();
}

std::vector<std::vector<double>*> ConvectedPressureRate::memory() {
  if (!by_mean_) return {};
  return mean_.memory();
}

}  // namespace vocalis::coupling
