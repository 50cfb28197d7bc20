#include "acoustic_solver/generalised_alpha.hpp"

#include <cassert>

namespace vocalis::acoustic {

namespace {

constexpr std::vector<double> Unknowns::*kAll[] = {&Unknowns::p, &Unknowns::psi, &Unknowns::layer_flux,
                                                   &Unknowns::layer_integral, &Unknowns::wall_motion};

}  // namespace

GeneralisedAlpha::GeneralisedAlpha(double spectral_radius)
    : rate_weight_(0.5 * (3 - spectral_radius) / (1 + spectral_radius)),
      flow_weight_(1 / (1 + spectral_radius)),
      rate_part_(0.5 + rate_weight_ - flow_weight_),
      rate_change_(1 / rate_part_) {}

GeneralisedAlpha GeneralisedAlpha::start() {
  GeneralisedAlpha result(1);
  result.rate_change_ = 1;
  return result;
}

Unknowns GeneralisedAlpha::shifted(const State& state, double dt) const {
  Unknowns result = state;
  if (!state.has_rates) return result;
  const double length = (rate_weight_ / rate_part_ - 1) * part() * dt;
  for (const auto which : kAll) {
    const std::vector<double>& rates = state.rates.*which;
    std::vector<double>& values = result.*which;
    assert(rates.size() == values.size());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += length * rates[i];
  }
  return result;
}

void GeneralisedAlpha::finish(const Unknowns& stage, double dt, bool keeps_rates, State& state) const {
  if (!keeps_rates) state.rates = {};
  state.has_rates = keeps_rates;
  for (const auto which : kAll) {
    const std::vector<double>& reached = stage.*which;
    std::vector<double>& values = state.*which;
    std::vector<double>& rates = state.rates.*which;
    if (keeps_rates) rates.resize(values.size(), 0.0);
    // The mean rate over the step is ẏ_n + γ (ẏ_n+1 - ẏ_n).
    for (std::size_t i = 0; i < values.size(); ++i) {
      const double change = (reached[i] - values[i]) / flow_weight_;
      values[i] += change;
      if (keeps_rates) rates[i] += rate_change_ * (change / dt - rates[i]);
    }
  }
}

}  // namespace vocalis::acoustic
