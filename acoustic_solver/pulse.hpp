#pragma once

#include <complex>
#include <variant>

namespace vocalis::acoustic {

/// A single smooth pulse of flux that contains all frequencies up to a highest one.
struct GaussianPulse {
  double amplitude = 1e-4;           ///< peak [m^3/s], or [m/s] if it prescribes a velocity
  double maximum_frequency = 10000;  ///< where the spectrum has fallen by 20 dB [Hz]
};

/// Periodic flux through the glottis in modal voice. The derivative is E0 exp(alpha t) sin(pi t / tp) until it reaches
/// -excitation at te, then returns to zero exponentially until the end of the period.
struct LiljencrantsFantPulse {
  double fundamental_frequency = 100;  ///< [Hz]
  double excitation = 0.4;             ///< Ee, steepest fall of the flux [m^3/s^2], or [m/s^2] of a velocity
  double open_quotient = 0.6;          ///< te, the instant of the steepest fall, over the period [-]
  double asymmetry = 0.75;             ///< tp, the instant of the greatest flux, over te; between 0.5 and 1 [-]
  double return_quotient = 0.03;       ///< ta, time constant of the return phase, over the period [-]
};

/// What drives the tract when no flow is computed.
using PulseSettings = std::variant<GaussianPulse, LiljencrantsFantPulse>;

/// Gaussian pulse ready for use: u(t) = amplitude exp(-(t - delay)^2 / (2 width^2)), with delay = 6 width, so that it
/// starts at 1.5e-8 of its peak; 2 pi width maximum_frequency = sqrt(2 ln 10).
class GaussianFlux {
 public:
  /// Throws UserError if the amplitude is zero or not finite, or the frequency not positive.
  explicit GaussianFlux(const GaussianPulse& settings);
  double value(double time) const;  ///< [unit of the amplitude]
  double rate(double time) const;   ///< du/dt [unit of the amplitude per second]
  /// Fourier integral of u(t) exp(-2 pi i f t) dt, f in [Hz] [unit of the amplitude times s]
  std::complex<double> spectrum(double frequency) const;
  double width() const { return width_; }      ///< standard deviation [s]
  double delay() const { return 6 * width_; }  ///< time of the peak [s]
  double end() const { return 12 * width_; }   ///< from here on below 1.5e-8 of the peak [s]

 private:
  double amplitude_;
  double width_;
};

/// LF pulses ready for use, from time 0 on, zero before. alpha makes the flux return to zero over a period.
/// Source: Fant, Liljencrants & Lin 1985, STL-QPSR 4, eqs. 1-4.
class LiljencrantsFantFlux {
 public:
  /// Throws UserError if a parameter is outside its range or the return phase does not fit into the closed phase.
  explicit LiljencrantsFantFlux(const LiljencrantsFantPulse& settings);
  double value(double time) const;             ///< flux [m^3/s or m/s]
  double rate(double time) const;              ///< its derivative [m^3/s^2 or m/s^2]
  double peak() const;                         ///< greatest flux, at tp
  double alpha() const { return alpha_; }      ///< growth of the open phase [1/s]
  double epsilon() const { return epsilon_; }  ///< decay of the return phase [1/s]

 private:
  double open_flux(double time) const;
  double return_flux(double after_excitation) const;

  double period_;
  double excitation_;
  double greatest_time_;    // tp
  double excitation_time_;  // te
  double time_constant_;    // ta
  double alpha_ = 0;
  double epsilon_ = 0;
};

/// A prescribed flux as a function of time, whichever kind.
class PulseFlux {
 public:
  /// Throws UserError as the kinds do.
  explicit PulseFlux(const PulseSettings& settings);
  double value(double time) const;
  double rate(double time) const;

 private:
  std::variant<GaussianFlux, LiljencrantsFantFlux> flux_;
};

}  // namespace vocalis::acoustic
