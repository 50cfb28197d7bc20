#pragma once

#include "coupling/analogies/force_source.hpp"
#include "coupling/analogies/running_mean.hpp"

namespace vocalis::coupling {

/// Acoustic perturbation equations with the convection of the mean flow U (the fourth system of Ewert & Schröder 2003,
/// for perturbations that are irrotational where they are sound):
///
///   (1 / (ρ c²)) D²(ρB')/Dt² - Δ(ρB') / ρ = div (ω × u + ν curl ω)',   D/Dt = ∂t + U·∇,     p' = ρ (B' - U·u')
///
/// (ω × u)' is the Lamb vector less its mean, u' = u_ic - U. The viscous force is heard from the walls alone
/// (`add_wall_friction`). Gradients of U in the operator are left out: they turn sound into vorticity, an effect of the
/// order of M. Both means forget with `mean_time`, so that the first of it is a start. p' is the total pressure but for
/// its mean. Needs of the flow: u_ic, and its viscosity.
class AcousticPerturbation : public Analogy {
 public:
  AcousticPerturbation(const acoustic::AnalogySettings& settings, AnalogyMedium medium);
  Unknown unknown() const override { return Unknown::enthalpy; }
  void follow(const FlowView& flow) override;
  AnalogySource source(const FlowView& flow) const override;
  std::vector<double> convection(const FlowView& flow) const override;
  std::vector<double> head(const FlowView& flow, const std::vector<double>& velocity) const override;
  std::vector<std::vector<double>*> memory() override;

 private:
  AnalogyMedium medium_;
  bool convects_;
  RunningMean mean_velocity_;  ///< (flow vertices, d) U
  RunningMean mean_load_;      ///< (flow vertices) of the Lamb vector's load
};

}  // namespace vocalis::coupling
