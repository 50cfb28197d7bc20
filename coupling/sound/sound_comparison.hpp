#pragma once

#include <string>
#include <vector>

#include "acoustic_solver/signals/third_octaves.hpp"
#include "core/base/log.hpp"
#include "coupling/figures.hpp"

namespace vocalis::coupling {

/// What several acoustic solvers have at one microphone: the first one's levels, and what the others have above them.
struct SoundComparison {
  struct Row {
    double band = 0;                 ///< nominal frequency of a third of an octave [Hz]; 0: all of the sound
    double level = 0;                ///< of the first solver [dB re 20 uPa]
    std::vector<double> difference;  ///< of the others [dB]; not a number where one of both is silent
  };
  std::string microphone;
  std::vector<std::string> solvers;
  std::vector<Row> rows;  ///< all of the sound, then the bands
};

/// One for each microphone, if a case has several solvers; otherwise none.
std::vector<SoundComparison> compare_sounds(const std::vector<ChannelSound>& sounds);

/// Prints them as tables.
void print_comparisons(base::Log& log, const std::vector<SoundComparison>& comparisons);

/// Writes third_octaves.csv: band_Hz (nominal), level_dB.MIC [dB re 20 µPa] of each solver and microphone. One rank,
/// not collective. Throws UserError if it cannot be written.
void write_third_octaves(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds);

}  // namespace vocalis::coupling
