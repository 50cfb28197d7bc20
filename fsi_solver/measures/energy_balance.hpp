#pragma once

#include "fsi_solver/measures/energy.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// What a scene that began at rest should hold of energy: all that was supplied and not dissipated since, counted as
/// the time scheme counts, so that EnergyRates::kept less `work` never rises where the equations are linear, and the
/// walls and dt stay as they are. The power P of a step's stage does work
///
///   θ      t … t⁺                     dt P
///   BDF2   t + ½ dt … t⁺ + ½ dt       dt P
///   anew   t … t⁺ + ½ dt              1.5 dt P
///
/// and where a step begins anew, work is first taken back to now, with the power that there was. Where dt changes, the
/// account goes on from what a last step of the new size would have kept.
struct EnergyBalance {
  KeptEnergy kept;   ///< by the last step
  double power = 0;  ///< supplied - dissipated at its stage [W]
  double dt = 0;     ///< its size [s]
  double work = 0;   ///< [J]

  void advance(const Stage& stage, const EnergyRates& rates) {
    const bool anew = !stage.remembers();
    work += anew ? -kept.share * dt * power : kept.value(stage.dt / dt) - kept.value();
    kept = rates.kept;
    power = rates.supplied - rates.dissipated;
    dt = stage.dt;
    work += (anew ? 1 + stage.ahead : 1) * dt * power;
  }
  double left() const { return kept.value() - work; }  ///< there is beyond it [J]
};

}  // namespace vocalis::fsi
