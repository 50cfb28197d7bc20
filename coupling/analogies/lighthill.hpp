#pragma once

#include "coupling/analogies/force_source.hpp"

namespace vocalis::coupling {

/// Lighthill's analogy (Lighthill 1952) with the tensor of an incompressible flow, T = ρ u u less the viscous stress,
/// which is heard from the walls alone (`add_wall_friction`), in weak form:
///
///   (1 / c²) (∂tt p, q) + (∇p, ∇q) = -(div ρ u u, ∇q) - <ρ ∂t u·n, q> - <µ n × ω, ∇q>
///
/// p is the total pressure. On the same mesh, with the same conditions on the total, it is p_ic + p_a of
/// `pressure_rate`, since div div T = -Δp_ic. Conditions at the air's boundaries (admittance, open, p = 0) are for the
/// total here. Needs of the flow: u_ic, and its viscosity.
class Lighthill : public Analogy {
 public:
  explicit Lighthill(AnalogyMedium medium) : medium_(std::move(medium)) {}
  Unknown unknown() const override { return Unknown::pressure; }
  AnalogySource source(const FlowView& flow) const override {
    return force_source(flow, medium_, CarriedMomentum::whole);
  }

 private:
  AnalogyMedium medium_;
};

}  // namespace vocalis::coupling
