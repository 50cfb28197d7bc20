#pragma once

#include <map>
#include <string>
#include <vector>

#include "acoustic_solver/signals/spectrum.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

/// What a finished run says: figures by name, each name with its unit (f0_Hz, F1_Hz, SPL_dB.mouth, gap_peak_m, ...).
/// Of the monitors' columns it says what the case's statistics ask for (see `statistics`), or else what a voice is made
/// of: peak and least gap, vibration, mean flow.
struct Figures {
  std::map<std::string, double> values;
  std::string vibration;  ///< "grows", "holds", "decays" or "none": the folds' amplitude from period to period
};

/// One microphone of one acoustic solver: its column in microphones.csv and the suffix of its results.
struct Channel {
  std::string suffix;  ///< "mouth", or "lighthill.mouth" where a case has several solvers
  std::string column;  ///< "pressure_Pa.mouth"
  std::string solver;
  std::string file;  ///< of the run folder: microphones.csv, or microphones_NAME.csv of a later solver
};
std::vector<Channel> channels(const Case& config);

/// The file of an acoustic solver's microphones, by its place in the case.
std::string microphones_file(const Case& config, std::size_t solver);

/// Column of the prescribed source in microphones.csv [m/s].
inline constexpr const char* source_column = "source_m_s";

/// A microphone's spectra, ready to write.
struct ChannelSpectrum {
  Channel channel;
  acoustic::PowerSpectrum power;
  std::vector<double> transfer_frequency;  ///< [Hz], equally spaced from 0; empty where the source is not known
  std::vector<double> transfer_level;      ///< |pressure over source| [dB re 1 Pa over the source's unit]
};

/// Reads history.csv and microphones.csv of a run folder and computes all figures; writes spectra.csv and one .wav per
/// microphone. One rank, not collective. Throws UserError if a file is missing, or has not the case's columns.
Figures evaluate_run(const Case& config, const std::string& folder);

}  // namespace vocalis::coupling
