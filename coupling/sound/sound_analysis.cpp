#include "coupling/sound/sound_analysis.hpp"

#include <algorithm>

#include "acoustic_solver/signals/driven_response.hpp"
#include "acoustic_solver/signals/ring_down.hpp"

namespace vocalis::coupling {

namespace {

constexpr int segment = 4096;              // [samples] of the spectral density: bins of 10.8 Hz at 44.1 kHz
constexpr double widest_formant = 600;     // [Hz] a broader oscillation is no formant
constexpr double highest_harmonic = 6000;  // [Hz]
constexpr double longest_source = 0.7;     // of the record: a source that goes on for longer leaves too little to ring

std::span<const double> since(std::span<const double> series, double rate, double begin) {
  return series.subspan(std::min(series.size(), static_cast<std::size_t>(begin * rate)));
}

}  // namespace

SoundAnalysis analyse_sound(std::span<const double> sound, std::span<const double> source, double rate, double begin,
                            std::optional<double> pitch) {
  SoundAnalysis result;
  const std::span<const double> late = since(sound, rate, begin);
  result.power = acoustic::welch(late, rate, segment);
  result.level = acoustic::sound_pressure_level(late);
  const double source_ends = static_cast<double>(acoustic::end_of_pulse(source));
  if (source_ends > 0 && source_ends < longest_source * static_cast<double>(source.size())) {
    auto response = acoustic::analyse_pulse_response(source, sound, rate, {.maximum_bandwidth = widest_formant});
    result.method = "ringing after the pulse (matrix pencil)";
    result.formants = std::move(response.formants);
    result.transfer_level = acoustic::magnitude_level(response.transfer);
    result.transfer_frequency = std::move(response.transfer.frequency);
    return result;
  }
  const std::span<const double> late_source = since(source, rate, begin);
  if (source.empty()) {
    result.method = "linear prediction of the sound alone (Burg, conventions of Praat)";
    result.formants = acoustic::formants_by_prediction(late, rate, {});
  } else {
    auto response = acoustic::driven_response(late_source, late, rate, {.maximum_bandwidth = widest_formant});
    result.method = "response to the source (ARX models)";
    result.formants = std::move(response.formants);
    result.transfer_level = std::move(response.level);
    result.transfer_frequency = std::move(response.frequency);
  }
  // A resonance that rings on is as periodic as the voice, so the sound is asked only where nothing else is known.
  result.pitch = pitch ? pitch : acoustic::fundamental_frequency(source.empty() ? late : late_source, rate).frequency;
  if (result.pitch) result.harmonics = acoustic::harmonics(late, rate, *result.pitch, highest_harmonic);
  return result;
}

}  // namespace vocalis::coupling
