#pragma once

#include <span>
#include <vector>

#include "acoustic_solver/formants.hpp"
#include "acoustic_solver/spectrum.hpp"

namespace vocalis::acoustic {

/// How a response is explained by its source.
struct DrivenModel {
  double sampling_rate = 10000;    ///< both series are resampled to this [Hz]; resonances up to half of it
  int order = 14;                  ///< past samples of the response, and present and past ones of the source
  double prominence = 6;           ///< of a resonance in the fitted transfer function [dB]
  double minimum_frequency = 100;  ///< [Hz]
};

/// A linear system found from what went in and what came out.
struct DrivenResponse {
  std::vector<Formant> formants;  ///< peaks of |H|, rising
  ComplexSpectrum transfer;       ///< H = response over source, 1 Hz apart
  double misfit = 0;              ///< rms of what one-step prediction leaves, over the rms of the response
};

/// The resonances between a known source and a response, in a voiced sound, too. Spectrum and linear prediction of the
/// sound alone see harmonics where a resonance lies between them (F1 of /i/!); with the source known,
///
///   p_n = sum_k a_k p_{n-k} + sum_k b_k q_{n-k},   k = 1 .. order for a, 0 .. order - 1 for b,
///
/// fits by least squares, and |B/A| has the system's peaks whatever the source's spectrum is, where it has any energy.
///
/// source, response  one number per sample each, at `rate` [Hz]. Series that are too short give an empty result.
/// Source: Ljung 1999, System Identification, section 4.2 (ARX model).
DrivenResponse driven_response(std::span<const double> source, std::span<const double> response, double rate,
                               const DrivenModel& model = {});

}  // namespace vocalis::acoustic
