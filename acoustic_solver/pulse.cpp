#include "acoustic_solver/pulse.hpp"

namespace vocalis::acoustic {

namespace {

using Flux = std::variant<GaussianFlux, LiljencrantsFantFlux, RosenbergFlux, RecordedFlux>;

Flux flux_of(const GaussianPulse& settings) { return GaussianFlux(settings); }
Flux flux_of(const LiljencrantsFantPulse& settings) { return LiljencrantsFantFlux(settings); }
Flux flux_of(const RosenbergPulse& settings) { return RosenbergFlux(settings); }
Flux flux_of(const RecordedSignal& settings) { return RecordedFlux(settings); }

std::optional<double> pitch_of(const GaussianPulse&) { return {}; }
std::optional<double> pitch_of(const LiljencrantsFantPulse& settings) { return settings.fundamental_frequency; }
std::optional<double> pitch_of(const RosenbergPulse& settings) { return settings.fundamental_frequency; }
std::optional<double> pitch_of(const RecordedSignal&) { return {}; }

}  // namespace

std::optional<double> prescribed_pitch(const PulseSettings& settings) {
  return std::visit([](const auto& kind) { return pitch_of(kind); }, settings);
}

PulseFlux::PulseFlux(const PulseSettings& settings)
    : flux_(std::visit([](const auto& kind) { return flux_of(kind); }, settings)) {}

double PulseFlux::value(double time) const {
  return std::visit([&](const auto& flux) { return flux.value(time); }, flux_);
}

double PulseFlux::rate(double time) const {
  return std::visit([&](const auto& flux) { return flux.rate(time); }, flux_);
}

}  // namespace vocalis::acoustic
