#pragma once

#include <array>

namespace vocalis::coupling {

/// The same velocity and pressure everywhere and always: no sound.
struct UniformFlow {
  std::array<double, 3> velocity = {0, 0, 0};  ///< [m/s]
  double pressure = 0;                         ///< [Pa]
};

inline std::array<double, 3> velocity(const UniformFlow& flow, const std::array<double, 3>&, double) {
  return flow.velocity;
}
inline double pressure(const UniformFlow& flow, const std::array<double, 3>&, double) { return flow.pressure; }

}  // namespace vocalis::coupling
