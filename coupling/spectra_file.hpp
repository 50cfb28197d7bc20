#pragma once

#include <string>
#include <vector>

#include "coupling/figures.hpp"

namespace vocalis::coupling {

/// Writes spectra.csv: frequency_Hz, psd_dB.MIC [dB re (20 µPa)²/Hz] and, where the source is known, transfer_dB.MIC
/// [dB re 1 Pa over the source's unit]. One rank, not collective. Throws UserError if it cannot be written.
void write_spectra(const std::string& path, const Case& config, const std::vector<ChannelSpectrum>& spectra);

}  // namespace vocalis::coupling
