#pragma once

#include "fsi_solver/settings.hpp"

namespace vocalis::fsi {

/// One time step as affine functions of its unknown, the end velocity v⁺ = v(t + dt). With v, v₋ (d, d₋) the values at
/// t and one step before, everything is evaluated at the stage:
///
///   v_s = weight v⁺ + (1 - weight) v            stage velocity
///   a_s = rate v⁺ + rate_now v + rate_before v₋ its rate; the same formula gives ∂t d from d⁺, d, d₋
///   d⁺  = (v_s - rate_now d - rate_before d₋) / rate   where the material moves with v, so that ∂t d = v_s
///   d_s = weight d⁺ + (1 - weight) d            stage geometry
///
/// One-leg θ: weight = θ, rate = 1/dt. BDF2: weight = 1, variable-step formula; its first step is backward Euler, whose
/// local error is O(dt²), so the order stays 2.
/// Source: Hairer, Wanner 1996, Solving ODEs II, III.5 (variable BDF2), V.6 (one-leg methods).
struct Stage {
  double dt = 0;           ///< [s]
  double weight = 1;       ///< [-]
  double rate = 0;         ///< [1/s]
  double rate_now = 0;     ///< [1/s]
  double rate_before = 0;  ///< [1/s]
  double ahead = 0;        ///< [dt] how far beyond t + dt is what the scheme keeps, see `EnergyRates`

  double at_stage(double end, double now) const { return weight * end + (1 - weight) * now; }
  double rate_of(double end, double now, double before) const {
    return rate * end + rate_now * now + rate_before * before;
  }
  double end_displacement(double stage_velocity, double now, double before) const {
    return (stage_velocity - rate_now * now - rate_before * before) / rate;
  }
  /// Whether it knows of the step before.
  bool remembers() const { return rate_before != 0; }
  /// Derivatives with respect to v⁺ of v_s and of the moving material's d_s.
  double velocity_slope() const { return weight; }
  double displacement_slope() const { return weight * weight / rate; }
};

/// Where Newton's method starts: from the velocity extrapolated in time, or from that of now.
enum class Start { extrapolated, present };

/// dt  [s] of this step; last_dt [s] of the step before, 0 if there was none
inline Stage make_stage(const TimeSettings& settings, double dt, double last_dt) {
  Stage stage;
  stage.dt = dt;
  if (settings.scheme == TimeScheme::theta) {
    stage.weight = settings.theta;
    stage.rate = 1 / dt;
    stage.rate_now = -1 / dt;
    return stage;
  }
  stage.ahead = 0.5;
  if (last_dt <= 0) {
    stage.rate = 1 / dt;
    stage.rate_now = -1 / dt;
  } else {
    const double ratio = dt / last_dt;
    stage.rate = (1 + 2 * ratio) / ((1 + ratio) * dt);
    stage.rate_before = ratio * ratio / ((1 + ratio) * dt);
    stage.rate_now = -stage.rate - stage.rate_before;
  }
  return stage;
}

}  // namespace vocalis::fsi
