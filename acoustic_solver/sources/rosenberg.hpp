#pragma once

namespace vocalis::acoustic {

/// Periodic flux through the glottis after Rosenberg's type C, of trigonometric pieces. With T the period, the glottis
/// opens during Tp, closes during Tn and is closed for the rest: open_quotient = (Tp + Tn) / T, speed_quotient = Tp /
/// Tn. The defaults are Tp = 0.40 T and Tn = 0.16 T, which listeners could not tell from natural pulses.
struct RosenbergPulse {
  double fundamental_frequency = 100;  ///< [Hz]
  double amplitude = 1;                ///< greatest flux [m^3/s], or [m/s] of a velocity
  double open_quotient = 0.56;         ///< [-]
  double speed_quotient = 2.5;         ///< [-]
};

/// Rosenberg's pulses ready for use, from time 0 on, zero before:
///
///   u = amplitude (1 - cos(pi t / Tp)) / 2          opening, 0 <= t < Tp
///   u = amplitude cos(pi (t - Tp) / (2 Tn))         closing, Tp <= t < Tp + Tn
///   u = 0                                           closed, to the end of the period
///
/// u is smooth but for the instant of closure, where its derivative jumps from -pi amplitude / (2 Tn) to 0: that is
/// what excites the tract. Source: Rosenberg 1971, J. Acoust. Soc. Am. 49, 583 (type C).
class RosenbergFlux {
 public:
  /// Throws UserError if a parameter is outside its range.
  explicit RosenbergFlux(const RosenbergPulse& settings);
  double value(double time) const;  ///< flux [unit of the amplitude]
  double rate(double time) const;   ///< its derivative [unit of the amplitude per second]

 private:
  double period_;
  double amplitude_;
  double opening_ = 0;  // Tp
  double closing_ = 0;  // Tn
};

}  // namespace vocalis::acoustic
