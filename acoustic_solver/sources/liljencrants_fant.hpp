#pragma once

namespace vocalis::acoustic {

/// Periodic flux through the glottis in modal voice. The derivative is E0 exp(alpha t) sin(pi t / tp) until it reaches
/// -excitation at te, then returns to zero exponentially until the end of the period.
struct LiljencrantsFantPulse {
  double fundamental_frequency = 100;  ///< [Hz]
  double excitation = 0.4;             ///< Ee, steepest fall of the flux [m^3/s^2], or [m/s^2] of a velocity
  double open_quotient = 0.6;          ///< te, the instant of the steepest fall, over the period [-]
  double asymmetry = 0.75;             ///< tp, the instant of the greatest flux, over te; between 0.5 and 1 [-]
  double return_quotient = 0.03;       ///< ta, time constant of the return phase, over the period [-]
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

}  // namespace vocalis::acoustic
