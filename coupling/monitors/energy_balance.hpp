#pragma once

namespace vocalis::coupling {

/// What a scene that began at rest should hold of energy: all that was supplied and not dissipated since. The powers of
/// the stages are joined by the trapezoidal rule, of second order; at rest there is none.
struct EnergyBalance {
  double time = 0;   ///< of the last stage [s]
  double power = 0;  ///< supplied - dissipated there [W]
  double work = 0;   ///< its integral [J]

  void advance(double stage_time, double stage_power) {
    work += 0.5 * (stage_time - time) * (power + stage_power);
    time = stage_time;
    power = stage_power;
  }
};

}  // namespace vocalis::coupling
