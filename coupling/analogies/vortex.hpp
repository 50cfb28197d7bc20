#pragma once

#include "coupling/analogies/force_source.hpp"

namespace vocalis::coupling {

/// Vortex sound (Powell 1964; Howe 1975) at low Mach numbers: the Lamb vector ω × u moves the total enthalpy B,
///
///   (1 / c²) (∂tt ρB, q) + (∇ρB, ∇q) = -(ρ ω × u, ∇q) - <ρ ∂t u·n, q> - <µ n × ω, ∇q>,
///   p = ρ (B - |u|² / 2) in the flow,
///
/// or ρ (B - w |u|² / 2) where the source has the weight w.
///
/// The source is where vorticity is, so it may be cut off outside. It differs from `lighthill` by (1 / c²) ∂tt ρ|u|²/2,
/// of the order of M². Needs of the flow: u_ic, and its viscosity.
class VortexSound : public Analogy {
 public:
  explicit VortexSound(AnalogyMedium medium) : medium_(std::move(medium)) {}
  Unknown unknown() const override { return Unknown::enthalpy; }
  AnalogySource source(const FlowView& flow) const override {
    return force_source(flow, medium_, CarriedMomentum::lamb);
  }
  std::vector<double> head(const FlowView& flow, const std::vector<double>& velocity) const override;

 private:
  AnalogyMedium medium_;
};

}  // namespace vocalis::coupling
