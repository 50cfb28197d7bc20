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
  double minimum_frequency = 100;  ///< of a resonance [Hz]
  double maximum_bandwidth = 600;  ///< [Hz] broader ones shape the skirts
  double least_own_level = -6;     ///< of a resonance at its frequency, over the whole transfer function there [dB]
  double agreement = 0.02;         ///< largest relative distance of one order's resonance from another's
};

/// A linear system found from what went in and what came out.
struct DrivenResponse {
  std::vector<Formant> formants;  ///< poles of H, rising; `level` is |H| there
  std::vector<double> frequency;  ///< [Hz], 1 Hz apart from 0
  std::vector<double> level;      ///< |H|, response over source [dB re 1 in its unit]
  double misfit = 0;              ///< rms of what one-step prediction leaves, bursts too, over that of the response
};

/// The resonances between a known source and a response, in a voiced sound, too. Spectrum and linear prediction of the
/// sound alone see harmonics where a resonance lies between them (F1 of /i/!); with the source known,
///
///   p_n = sum_k a_k p_{n-k} + sum_k b_k q_{n-k},   k = 1 .. order for a, 0 .. order - 1 for b,
///
/// is fitted, and H = B/A has the system's poles whatever the source's spectrum is, where it has any energy. Sound of
/// which the source says nothing, as that of folds that meet, comes in short bursts: an error counts by its square as
/// long as it is one of the usual ones, and by its size beyond that (Huber's weights). Formants are those that recur
/// from order to order, see `recurring_formants`; the level is the median over the orders.
///
/// source, response  one number per sample each, at `rate` [Hz]. Series that are too short give an empty result.
/// Source: Ljung 1999, System Identification, sections 4.2 (ARX model) and 15.2 (robust norms); Huber 1964, Ann. Math.
/// Stat. 35, 73; Holland & Welsch 1977, Commun. Stat. A 6, 813 (weights anew after each solution).
DrivenResponse driven_response(std::span<const double> source, std::span<const double> response, double rate,
                               const DrivenModel& model = {});

}  // namespace vocalis::acoustic
