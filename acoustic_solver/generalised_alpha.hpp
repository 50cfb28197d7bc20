#pragma once

#include "acoustic_solver/state.hpp"

namespace vocalis::acoustic {

/// The generalised-α scheme for equations of first order, ẏ = f(y, t): of second order, unconditionally stable, and
/// with one number for the damping of what a step does not resolve (Jansen, Whiting & Hulbert 2000, Comput. Methods
/// Appl. Mech. Engrg. 190, 305, eqs. 9-11, 17-19):
///
///   ẏ_n + α_m (ẏ_n+1 - ẏ_n) = f(y_n + α_f (y_n+1 - y_n), t_n + α_f dt),    y_n+1 = y_n + dt (ẏ_n + γ (ẏ_n+1 - ẏ_n)),
///   α_m = (3 - r) / (2 + 2r),    α_f = 1 / (1 + r),    γ = 1/2 + α_m - α_f,    r the spectral radius.
///
/// An oscillation of ω dt ≫ 1 alternates in sign and is multiplied by r a step. r = 1 is Crank–Nicolson, which needs no
/// ẏ. Its stage, the values at α_f, is reached by a step of implicit Euler of length θ dt, θ = γ α_f / α_m, from
/// y* = y_n + (α_m / γ - 1) θ dt ẏ_n: whatever knows implicit Euler can be advanced so.
class GeneralisedAlpha {
 public:
  /// spectral_radius  r, from 0 to 1
  explicit GeneralisedAlpha(double spectral_radius);

  /// The scheme's first step, while ẏ is not known: Crank–Nicolson, after which ẏ is its mean over the step.
  static GeneralisedAlpha start();

  /// α_f: where f is wanted, as a part of the step.
  double at() const { return flow_weight_; }
  /// θ.
  double part() const { return rate_part_ * flow_weight_ / rate_weight_; }

  /// y* of all unknowns, from the state at the beginning and its rates.
  Unknowns shifted(const State& state, double dt) const;

  /// Moves the state and its rates on, given the unknowns at α_f; `keeps_rates` unless r = 1.
  void finish(const Unknowns& stage, double dt, bool keeps_rates, State& state) const;

 private:
  double rate_weight_, flow_weight_, rate_part_;  ///< α_m, α_f, γ
  double rate_change_;                            ///< of ẏ, over that of the step's mean rate from it: 1 / γ
};

}  // namespace vocalis::acoustic
