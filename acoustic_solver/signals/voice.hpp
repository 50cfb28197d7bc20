#pragma once

#include <optional>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// Where the pitch is looked for, and how periodic a voiced sound must be.
struct PitchSettings {
  double minimum_frequency = 60;   ///< [Hz]
  double maximum_frequency = 500;  ///< [Hz]
  double minimum_confidence = 0.5;
  double octave_cost = 0.01;  ///< by how much the correlation must rise for a period twice as long to be preferred
};

/// The pitch of a sound or of a vibration.
struct Pitch {
  std::optional<double> frequency;  ///< [Hz]; none: unvoiced
  double confidence = 0;            ///< correlation of the series with itself one period later; 1: exactly periodic
  double periods = 0;               ///< how many periods the series has
};

/// Fundamental frequency: the lag tau, at most a quarter of the series, with the greatest normalised correlation
///
///   r(tau) = sum x(t) x(t + tau) / sqrt(sum x(t)^2 sum x(t + tau)^2)
///
/// at the vertex of the parabola through three lags, less octave_cost per doubling of tau. r is 1 also for a periodic
/// series that grows or decays exponentially. The mean is removed.
///
/// sampling_rate  [Hz], > 0
/// Source: Boersma 1993, Proc. Inst. Phonetic Sciences 17 (octave cost); Talkin 1995 (normalisation).
Pitch fundamental_frequency(std::span<const double> series, double sampling_rate, const PitchSettings& settings = {});

/// One line of a voiced sound.
struct Harmonic {
  int number = 0;        ///< 1 is the fundamental
  double frequency = 0;  ///< [Hz]
  double amplitude = 0;  ///< of the cosine [unit of the series]
  double level = 0;      ///< 20 log10(amplitude / sqrt(2) / 20 uPa) [dB], if the series is a pressure [Pa]
};

/// Harmonics of a series up to `maximum_frequency` and half the sampling rate, over the last whole number of periods
/// under a Hann window. Needs three periods, else empty.
std::vector<Harmonic> harmonics(std::span<const double> series, double sampling_rate, double fundamental_frequency,
                                double maximum_frequency);

/// What an oscillation does from period to period.
enum class Trend { none, decays, holds, grows };

/// Growth of an oscillation.
struct Growth {
  Trend trend = Trend::none;       ///< none: no period found
  double factor = 0;               ///< of the amplitude per period
  double scatter = 0;              ///< rms deviation of log(amplitude) from the fitted line
  double frequency = 0;            ///< [Hz]
  std::vector<double> amplitudes;  ///< half of maximum minus minimum of each period [unit of the series]
};

/// Fits log(amplitude) of successive periods by a straight line. The amplitude of a period is half the difference of
/// its extrema, so that a slowly drifting mean does no harm. `tolerance`: factors within 1 +- tolerance hold.
Growth growth(std::span<const double> series, double sampling_rate, double tolerance = 0.01,
              const PitchSettings& settings = {});

/// "none", "decays", "holds" or "grows".
const char* name(Trend trend);

}  // namespace vocalis::acoustic
