#include "acoustic_solver/implicit_convection.hpp"

#include <cmath>

#include "acoustic_solver/relative_change.hpp"

namespace vocalis::acoustic {

ImplicitConvection::ImplicitConvection(const fem::Space& space, const WaveOperator& wave, const YieldingWalls& walls,
                                       double density, double beta, const Unknowns& beginning)
    : space_(&space),
      wave_(&wave),
      walls_(&walls),
      beginning_(&beginning),
      density_(density),
      beta_(beta),
      base_(beginning.p),
      held_(beginning.p.size(), 0.0) {
  for (const std::int32_t v : wave.inlets()) base_[v] = 0;
}

void ImplicitConvection::at_stage(const std::vector<double>& increment, std::vector<double>& pressure,
                                  std::vector<double>& potential) const {
  pressure = base_;
  potential.resize(pressure.size());
  const double b = beta_ / density_;
  for (std::size_t v = 0; v < pressure.size(); ++v) {
    pressure[v] += increment[v];
    potential[v] = beginning_->psi[v] + b * pressure[v] + beta_ * held_[v];
  }
}

void ImplicitConvection::update(const std::vector<double>& increment) {
  std::vector<double> potential;
  at_stage(increment, convected_, potential);
  const bool is_first = rates_.empty();
  before_ = rates_;
  wave_->potential_convection(potential, convected_, rates_, walls_->velocities(beta_, convected_, *beginning_));
  // Of ψ_θ and the new r, p_θ / ρ = (ψ_θ - ψ*) / (θ dt) - r. Where the mesh alone moves, v dt / h is small, and the p_θ
  // that ψ_θ was found with serves as well.
  if (wave_->flows() && !is_first) {
    for (std::size_t v = 0; v < rates_.size(); ++v) convected_[v] += density_ * (held_[v] - rates_[v]);
  }
  held_ = rates_;
  for (const std::int32_t v : wave_->inlets()) {
    convected_[v] = -density_ * rates_[v];
    held_[v] = 0;
  }
}

bool ImplicitConvection::has_settled(double tolerance) const {
  double change = 0, size = 0;
  for (std::int32_t v = 0; v < space_->dofs.num_owned; ++v) {
    change += std::pow(density_ * (rates_[v] - before_[v]), 2);
    size += std::pow(convected_[v], 2);
  }
  return is_small_change(space_->mesh->comm, change, size, tolerance);
}

void ImplicitConvection::finish(const std::vector<double>& increment, Unknowns& stage) const {
  for (std::size_t v = 0; v < base_.size(); ++v) {
    const double pressure = base_[v] + increment[v];
    stage.psi[v] += beta_ * (pressure / density_ + held_[v]);
    stage.p[v] = pressure;
  }
  for (const std::int32_t v : wave_->inlets()) stage.p[v] = -density_ * rates_[v];
}

void ImplicitConvection::add_terms(std::vector<double>& right_hand_side) const {
  std::vector<double> terms(held_.size(), 0.0), scaled = held_;
  wave_->add_convection(convected_, wave_->momentum(convected_), terms);
  for (double& value : scaled) value *= beta_;
  wave_->add_convecting_stiffness(-1, scaled, terms);
  if (wave_->flows()) {
    for (std::size_t v = 0; v < scaled.size(); ++v) scaled[v] = density_ * held_[v];
    wave_->add_open_admittance(-1, scaled, terms);
  }
  space_->halo.add_to_owners(terms);
  if (wave_->has_inlets()) {
    std::vector<double> change(terms.size(), 0.0);
    for (const std::int32_t v : wave_->inlets()) change[v] = (beginning_->p[v] + density_ * rates_[v]) / beta_;
    const std::vector<double> inertia = wave_->momentum(change);
    for (std::size_t v = 0; v < terms.size(); ++v) terms[v] += inertia[v];
  }
  for (std::size_t v = 0; v < terms.size(); ++v) right_hand_side[v] += terms[v];
}

}  // namespace vocalis::acoustic
