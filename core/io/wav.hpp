#pragma once

#include <span>
#include <string>
#include <vector>

namespace vocalis::io {

/// How a sound file holds pascals. The comment of the file says which pressure the sample 1.0 stands for.
struct WavSettings {
  enum class Format { float32, int16 };
  int sampling_rate = 44100;        ///< [Hz]
  Format format = Format::float32;  ///< int16 is scaled so that the largest pressure nearly fills its range
  double full_scale = 1;            ///< float32 only: pressure of the sample 1.0 [Pa]
};

/// Sound of one channel in pascals.
struct Sound {
  int sampling_rate = 0;         ///< [Hz]
  std::vector<double> pressure;  ///< [Pa]
  std::string comment;
};

/// Writes a sound of one channel. One rank writes; not collective.
///
/// pressure  at the sampling rate of the settings [Pa]
/// returns   the pressure that the sample 1.0 stands for [Pa]
/// Throws UserError if the file cannot be written or a pressure is not finite.
double write_wav(const std::string& path, std::span<const double> pressure, const WavSettings& settings = {});

/// Reads the first channel of a sound file, times the factor in its comment (1 if there is none). Not collective.
/// Throws UserError if the file cannot be read.
Sound read_wav(const std::string& path);

}  // namespace vocalis::io
