#pragma once

#include "coupling/analogies/pressure_source.hpp"
#include "coupling/analogies/running_mean.hpp"

namespace vocalis::coupling {

/// The perturbed convective wave equation (Hüppe & Kaltenbacher 2012; for moving walls Schoder 2022): what
/// `pressure_rate` takes at fixed points it takes along the flow U, in the source and in the wave operator,
///
///   (1 / (ρ c²)) Dp_a/Dt + div u_a = -(1 / (ρ c²)) Dp_ic/Dt,     D/Dt = ∂t + U·∇,     u_a = -∇ψ,  ρ Dψ/Dt = p_a
///
/// U is the present flow, or its mean (`mean_flow`). Without `convection` the operator is that of air at rest: sound is
/// carried by M times its way, which is little where the flow is short. As M falls it tends to `pressure_rate`. Needs
/// of the flow: p_ic and u_ic.
class ConvectedPressureRate : public Analogy {
 public:
  ConvectedPressureRate(const acoustic::AnalogySettings& settings, AnalogyMedium medium);
  void follow(const FlowView& flow) override;
  AnalogySource source(const FlowView& flow) const override;
  std::vector<double> convection(const FlowView& flow) const override;
  std::vector<std::vector<double>*> memory() override;

 private:
  std::vector<double> flow_velocity(const FlowView& flow) const;

  AnalogyMedium medium_;
  bool convects_, by_mean_;
  RunningMean mean_;
};

}  // namespace vocalis::coupling
