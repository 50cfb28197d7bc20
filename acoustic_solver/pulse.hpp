#pragma once

#include <optional>
#include <variant>

#include "acoustic_solver/sources/gaussian_pulse.hpp"
#include "acoustic_solver/sources/liljencrants_fant.hpp"
#include "acoustic_solver/sources/recorded_signal.hpp"
#include "acoustic_solver/sources/rosenberg.hpp"

namespace vocalis::acoustic {

/// What drives the tract when no flow is computed.
using PulseSettings = std::variant<GaussianPulse, LiljencrantsFantPulse, RosenbergPulse, RecordedSignal>;

/// The pitch that a source has by its settings [Hz]; none: a single pulse, or a signal, whose pitch is to be looked
/// for.
std::optional<double> prescribed_pitch(const PulseSettings& settings);

/// A prescribed flux as a function of time, whichever kind.
class PulseFlux {
 public:
  /// Throws UserError as the kinds do.
  explicit PulseFlux(const PulseSettings& settings);
  double value(double time) const;
  double rate(double time) const;

 private:
  std::variant<GaussianFlux, LiljencrantsFantFlux, RosenbergFlux, RecordedFlux> flux_;
};

}  // namespace vocalis::acoustic
