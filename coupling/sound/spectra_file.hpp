#pragma once

#include <string>
#include <vector>

#include "coupling/figures.hpp"

namespace vocalis::coupling {

/// Writes spectra.csv: frequency_Hz, psd_dB.MIC [dB re (20 µPa)²/Hz] and, where the source is known, transfer_dB.MIC
/// [dB re 1 Pa over the source's unit]. One rank, not collective. Throws UserError if it cannot be written.
void write_spectra(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds);

/// Writes harmonics.csv: harmonic (1 is the fundamental), and of each microphone with a voiced sound frequency_Hz.MIC
/// and level_dB.MIC [dB re 20 µPa]; no rows if there is none. One rank, not collective. Throws UserError if it cannot
/// be written.
void write_harmonics(const std::string& path, const Case& config, const std::vector<ChannelSound>& sounds);

}  // namespace vocalis::coupling
