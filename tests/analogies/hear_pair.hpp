#pragma once

#include <complex>
#include <string>
#include <vector>

#include "tests/analogies/spinning_pair.hpp"

namespace vocalis::coupling::test {

struct Resolution {
  double cells_a_core = 2;         ///< core radius over cell size
  double growth = 0.15;            ///< of cell size with the distance from the vortices' path
  double cells_a_wavelength = 15;  ///< at the largest cells
  int steps_a_period = 32;         ///< of sound
};

struct Model {
  std::string analogy;
  bool convection = true;   ///< in the wave operator of `pcwe` and `ape`
  double mean_periods = 5;  ///< of sound, T of the running means of `ape`
};

struct Heard {
  Model model;
  std::complex<double> wave;   ///< over the formula's
  std::complex<double> exact;  ///< the analogy's own solution, over the formula's
  double seconds = 0;          ///< of this rank's processor for its sound
};

inline double degrees(std::complex<double> ratio) { return std::arg(ratio) * 180 / M_PI; }

/// ∂t p_ic is no compact source; Lighthill's tensor and the Lamb vector are.
inline bool needs_near_field(const std::string& analogy) { return analogy == "pressure_rate" || analogy == "pcwe"; }

/// What voices hear of the pair on cases/vortex_pair/disc.geo at 1.6 wavelengths, beside what they must; prints it.
/// Six periods of sound: it fades in over 1.5 and takes 1.6 to the microphones. Collective.
std::vector<Heard> listen(const SpinningPair& pair, const std::vector<Model>& models, const Resolution& resolution,
                          int periods = 6);

}  // namespace vocalis::coupling::test
