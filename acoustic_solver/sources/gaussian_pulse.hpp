#pragma once

#include <complex>

namespace vocalis::acoustic {

/// A single smooth pulse of flux that contains all frequencies up to a highest one.
struct GaussianPulse {
  double amplitude = 1e-4;           ///< peak [m^3/s], or [m/s] if it prescribes a velocity
  double maximum_frequency = 10000;  ///< where the spectrum has fallen by 20 dB [Hz]
};

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

}  // namespace vocalis::acoustic
