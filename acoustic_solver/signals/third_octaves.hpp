#pragma once

#include <vector>

#include "acoustic_solver/signals/spectrum.hpp"

namespace vocalis::acoustic {

/// Level of a band of a third of an octave.
struct BandLevel {
  double nominal = 0;  ///< its name, about its middle [Hz]
  double level = 0;    ///< [dB re 20 uPa], not below -300 dB
};

/// Levels of the bands from 100 Hz to 8 kHz, each the integral of the density between the band's edges, where a bin
/// that an edge cuts counts in part. Bands narrower than two bins, or beyond the last one, are left out.
///
/// pressure  density [Pa^2/Hz]
/// Source: IEC 61260-1:2014: middles 1000 * 10^(n/10) Hz, edges 10^(1/20) below and above.
std::vector<BandLevel> third_octaves(const PowerSpectrum& pressure);

}  // namespace vocalis::acoustic
