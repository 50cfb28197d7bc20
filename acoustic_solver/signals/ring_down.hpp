#pragma once

#include <complex>
#include <span>
#include <vector>

#include "acoustic_solver/signals/formants.hpp"
#include "acoustic_solver/signals/spectrum.hpp"

namespace vocalis::acoustic {

/// One damped oscillation p(t) = Re(a exp(s (t - t0))): what is left of a resonance when the source is silent.
struct DampedMode {
  std::complex<double> exponent;   ///< s = -pi bandwidth + 2 pi i frequency [1/s]
  std::complex<double> amplitude;  ///< a at the beginning t0 of the series [unit of the series]
  double doubt = 0;                ///< standard error of the amplitude over the amplitude

  double frequency() const;  ///< [Hz]
  double bandwidth() const;  ///< between the half-power points [Hz]
};

/// Which part of a ring-down is analysed, and what counts as a resonance.
struct RingDown {
  double minimum_frequency = 50;    ///< [Hz]
  double maximum_frequency = 6000;  ///< [Hz]; the series is low-passed and thinned to about four times this rate
  double maximum_bandwidth = 1500;  ///< broader oscillations are not taken for resonances [Hz]
  double maximum_doubt = 0.2;       ///< modes whose amplitude is less certain are noise
  int maximum_samples = 1200;       ///< after thinning; the rest of a longer record is left out
};

/// The damped oscillations in a freely ringing series, in rising order of frequency. A record shorter than the inverse
/// of a bandwidth is no obstacle: the poles are found from the shift invariance of the signal space of the Hankel
/// matrix (matrix pencil, total least squares), not from a spectrum. Everything in the series must ring freely: drop
/// what the source was still driving. Too short a series, silence, or one that is not finite gives an empty result.
///
/// sampling_rate  [Hz], > 0
/// Source: Hua & Sarkar 1990, IEEE Trans. Acoust. Speech Signal Process. 38; Kung, Arun & Bhaskar Rao 1983, J. Opt.
/// Soc. Am. 73 (shift invariance).
std::vector<DampedMode> damped_modes(std::span<const double> series, double sampling_rate, const RingDown& settings);

/// Samples of a source up to the last one above 1e-5 of its largest: from there on a response rings freely. 0 for
/// silence.
std::size_t end_of_pulse(std::span<const double> flux);

/// Result of the pulse mode of a vocal tract.
struct PulseResponse {
  std::vector<Formant> formants;  ///< rising; `level` is that of the transfer function at the formant
  ComplexSpectrum transfer;       ///< pressure over flux [Pa s/m^3 if the flux is m^3/s]
};

/// Formants and transfer function of a vocal tract from its response to a flux pulse. The formants are the damped modes
/// of the pressure from `settle` after the pulse on, but for those that do not shape the transfer function at their own
/// frequency (12 dB below it). Frequency and bandwidth are those of the pole; where resonances overlap, the peak of |H|
/// lies some tenths of a per cent beside it. The transfer function is that of the record continued for ever by these
/// modes, so that a record that ends while F1 still rings does not smear it.
///
/// flux      source, a pulse that has ended well before the record does; one number per step
/// pressure  at the microphone [Pa], as many numbers
/// settle    time after the pulse for the first wave to reach the microphone [s]
/// bin_width of the transfer function [Hz]
PulseResponse analyse_pulse_response(std::span<const double> flux, std::span<const double> pressure,
                                     double sampling_rate, const RingDown& settings, double settle = 1e-3,
                                     double bin_width = 1.0);

}  // namespace vocalis::acoustic
