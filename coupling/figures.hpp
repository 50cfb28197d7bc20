#pragma once

#include <map>
#include <string>
#include <vector>

#include "coupling/case/case.hpp"
#include "coupling/sound/sound_analysis.hpp"

namespace vocalis::coupling {

/// One microphone, of one acoustic solver or of a surface of the flow: its column in microphones.csv and the suffix of
/// its results.
struct Channel {
  std::string suffix;      ///< "mouth", or "lighthill.mouth" where a case has several solvers
  std::string column;      ///< "pressure_Pa.mouth"
  std::string solver;      ///< or "NAME (curle)", "NAME (fwh)" of a microphone that hears a surface
  std::string microphone;  ///< the first one at the same place, for one that hears a surface
  std::string file;        ///< of the run folder: microphones.csv, or microphones_NAME.csv of a later solver
};

/// A microphone and what it heard.
struct ChannelSound {
  Channel channel;
  SoundAnalysis analysis;
};

/// What a finished run says: figures by name, each name with its unit (f0_Hz, F1_Hz, SPL_dB.mouth, gap_peak_m, ...).
/// Of the monitors' columns it says what the case's statistics ask for (see `statistics`), or else what a voice is made
/// of: peak and least gap, vibration, mean flow, and the cycles of the glottis (see `analyse_phonation`).
struct Figures {
  std::map<std::string, double> values;
  std::string vibration;  ///< "grows", "holds", "decays" or "none": the folds' amplitude from period to period
  std::vector<ChannelSound> sounds;
};

/// All microphones of a case, solver by solver, then those of surfaces.
std::vector<Channel> channels(const Case& config);

/// The file of an acoustic solver's microphones, by its place in the case.
std::string microphones_file(const Case& config, std::size_t solver);

/// Column of the prescribed source in microphones.csv [m/s].
inline constexpr const char* source_column = "source_m_s";

/// Reads history.csv and microphones.csv of a run folder and computes all figures; writes periods.csv, spectra.csv,
/// harmonics.csv, third_octaves.csv and one .wav per microphone. One rank, not collective. Throws UserError if a file
/// is missing, or has not the case's columns.
Figures evaluate_run(const Case& config, const std::string& folder);

}  // namespace vocalis::coupling
