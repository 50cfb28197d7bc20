#pragma once

#include <complex>
#include <string>

#include "tests/analogies/spinning_pair.hpp"

namespace vocalis::coupling::test {

/// Weight of a source as voices apply it: 1 within the radius, falling as a cosine to 0 over the width [m].
struct SourceWindow {
  double radius = 0, width = 0;
  double end() const { return radius + width; }
  double weight(double r) const;
  double slope(double r) const;  ///< ∂r of the weight [1/m]
};

/// What an analogy makes of the pair to any order in its Mach number, without a mesh: C of the wave of 2ω beyond the
/// window over the formula's (`far_field`), in the free plane, for a wave operator without flow.
///
/// All about the pair is a function of r and θ - ωt. So the wave of 2ω is the one of e^{2iθ} alone, and beyond the
/// source S of (1/c²) ∂tt p - Δp = S
///
///   p = Re[ H2⁽²⁾(kr) / (2i) ∬ S J2(kr') e^{2iθ'} dx dy  e^{2i(ωt - θ)} ],
///
/// S at time 0, where the formula has 2A in place of the integral. Derivatives in S go over to J2 e^{2iθ} by parts.
///
/// analogy  lighthill, vortex, pressure_rate, or pcwe without `convection`
std::complex<double> exact_at_rest(const SpinningPair& pair, const std::string& analogy, const SourceWindow& window);

/// The same where the flow U carries sound, (1/c²) D²ψ/Dt² - Δψ = S, D/Dt = ∂t + U·∇: by linear elements in r for the
/// parts of order 0, ±2 .. ±6 of θ in the frame that turns with the pair, where D/Dt = U·∇ - ω ∂θ is steady and, as
/// div U = 0, its own adjoint but for the sign; a wave that leaves at the flow's end.
///
/// analogy     pcwe, with U = u; or ape, with U the mean swirl
/// convection  false: D/Dt is ∂t in the operator, and `ape` is `vortex`
/// elements    over those of the least number, for its convergence
std::complex<double> exact_in_flow(const SpinningPair& pair, const std::string& analogy, const SourceWindow& window,
                                   bool convection = true, double elements = 1);

}  // namespace vocalis::coupling::test
