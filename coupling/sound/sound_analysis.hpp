#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/signals/formants.hpp"
#include "acoustic_solver/signals/spectrum.hpp"
#include "acoustic_solver/signals/voice.hpp"

namespace vocalis::coupling {

/// What a microphone's sound says by itself and beside its source
struct SoundAnalysis {
  acoustic::PowerSpectrum power;
  double level = 0;                           ///< [dB re 20 µPa]
  std::string method;                         ///< how the formants were found, for people
  std::vector<acoustic::Formant> formants;    ///< rising
  std::vector<double> transfer_frequency;     ///< [Hz], equally spaced from 0; empty where the source is not known
  std::vector<double> transfer_level;         ///< |pressure over source| [dB re 1 Pa over the source's unit]
  std::optional<double> pitch;                ///< [Hz]; none: not voiced
  std::vector<acoustic::Harmonic> harmonics;  ///< of a voiced sound
};

/// Analyses one microphone's sound. The formants are those of the ring after a pulse, if the source is known and silent
/// for the last part of the record (`analyse_pulse_response`); of the response to the source, if that goes on
/// (`driven_response`); and of the sound alone, if nothing is known about the source (`formants_by_prediction`). After
/// a pulse there is no pitch.
///
/// sound   [Pa] from time 0 on
/// source  at the same times, in any unit; empty: not known
/// rate    of both [Hz]
/// pitch   of what makes the sound, if that is known [Hz]; otherwise that of the source, or else the sound's own
/// begin   what is before this time counts neither for level nor spectrum, nor for voiced sound at all [s]
SoundAnalysis analyse_sound(std::span<const double> sound, std::span<const double> source, double rate, double begin,
                            std::optional<double> pitch = {});

}  // namespace vocalis::coupling
