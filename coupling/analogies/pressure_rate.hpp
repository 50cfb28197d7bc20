#pragma once

#include "coupling/analogies/pressure_source.hpp"

namespace vocalis::coupling {

/// The pressure-rate analogy (Degirmenci 2018, eq. 3.1, with the sign that mass conservation gives): Q = -(1 / (ρ c²))
/// ∂t p_ic at a fixed point of space, and the flux through the outlet, see `pressure_source`. Ribner's dilatation
/// (Ribner 1962), (1 / c²) ∂tt p_1 - Δp_1 = -(1 / c²) ∂tt p_ic, is the same after eliminating u_a.
///
/// With the plain difference over a step as the rate the source's integral in time is exact. Needs of the flow: p_ic,
/// and u_ic at an outlet.
class PressureRate : public Analogy {
 public:
  explicit PressureRate(AnalogyMedium medium) : medium_(std::move(medium)) {}
  AnalogySource source(const FlowView& flow) const override {
    return pressure_source(flow, medium_, flow.mesh_velocity);
  }

 private:
  AnalogyMedium medium_;
};

}  // namespace vocalis::coupling
