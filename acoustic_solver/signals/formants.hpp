#pragma once

#include <limits>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// A resonance of the vocal tract.
struct Formant {
  double frequency = 0;                                     ///< [Hz]
  double bandwidth = 0;                                     ///< between the half-power points [Hz]
  double level = std::numeric_limits<double>::quiet_NaN();  ///< [dB] of what was analysed, where that is known
  /// half of what the frequency ranges over when the model's order changes, where several were fitted [Hz]
  double spread = std::numeric_limits<double>::quiet_NaN();
};

/// How linear prediction cuts and models the sound.
struct LinearPrediction {
  int formants = 5;                 ///< two coefficients each
  double ceiling = 5000;            ///< the sound is resampled to twice this [Hz]; 5000 for men, 5500 for women
  double pre_emphasis = 50;         ///< from here on +6 dB per octave [Hz]
  double maximum_bandwidth = 1000;  ///< broader roots shape the tilt of the spectrum and are no resonances [Hz]
  double window_length = 0.025;     ///< effective length of a Gaussian window, half of its whole length [s]
};

/// Formants by linear prediction (Burg), the median over frames that follow at a quarter of the window length. A frame
/// gives its roots above 50 Hz and below ceiling - 50 Hz, if not too broad, in rising order; formant k is the median of
/// those frames that have k formants, and is left out where fewer than half of them do. Too short a record gives an
/// empty result.
///
/// sampling_rate  [Hz], > 0
/// Source: Childers 1978 (Burg's recursion); conventions of "To Formant (burg)" in Praat (Boersma & Weenink),
/// which keeps the broad roots.
std::vector<Formant> formants_by_prediction(std::span<const double> series, double sampling_rate,
                                            const LinearPrediction& settings);

/// Coefficients a of the prediction x_n = sum_k a[k-1] x_{n-k}, k = 1 .. order, that Burg's recursion gives: it
/// minimises the forward and backward errors together. All zero for silence. Needs more than `order` samples.
std::vector<double> burg_coefficients(std::span<const double> series, int order);

}  // namespace vocalis::acoustic
