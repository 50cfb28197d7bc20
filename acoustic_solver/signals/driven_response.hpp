#pragma once

#include <span>
#include <vector>

#include "acoustic_solver/signals/formants.hpp"
#include "acoustic_solver/signals/spectrum.hpp"

namespace vocalis::acoustic {

/// How a response is explained by its source.
struct DrivenModel {
  double sampling_rate = 10000;    ///< both series are resampled to this [Hz]; resonances up to 0.45 of it
  int lowest_order = 14;           ///< past samples of the response, and present and past ones of the source
  int highest_order = 26;          ///< every second order between the two is fitted, too
  double prominence = 6;           ///< of a resonance in the transfer function [dB]
  double minimum_frequency = 100;  ///< [Hz]
};

/// A linear system found from what went in and what came out.
struct DrivenResponse {
  std::vector<Formant> formants;  ///< peaks of |H|, rising
  std::vector<double> frequency;  ///< [Hz], 1 Hz apart from 0
  std::vector<double> level;      ///< |H|, response over source [dB re 1 in its unit]
  double misfit = 0;              ///< rms of what one-step prediction leaves, over the rms of the response
};

/// The resonances between a known source and a response, in a voiced sound, too. Spectrum and linear prediction of the
/// sound alone see harmonics where a resonance lies between them (F1 of /i/!); with the source known,
///
///   p_n = sum_k a_k p_{n-k} + sum_k b_k q_{n-k},   k = 1 .. order for a, 0 .. order - 1 for b,
///
/// fits by least squares, and |B/A| has the system's peaks whatever the source's spectrum is, where it has any energy.
/// A single order invents a peak now and then, each order another one: the level is the median over several orders.
///
/// source, response  one number per sample each, at `rate` [Hz]. Series that are too short give an empty result.
/// Source: Ljung 1999, System Identification, section 4.2 (ARX model).
DrivenResponse driven_response(std::span<const double> source, std::span<const double> response, double rate,
                               const DrivenModel& model = {});

}  // namespace vocalis::acoustic
