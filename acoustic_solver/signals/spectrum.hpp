#pragma once

#include <complex>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// 20 uPa, the root mean square pressure of 0 dB [Pa].
inline constexpr double reference_pressure = 20e-6;

/// Power spectral density of a series x [X].
struct PowerSpectrum {
  std::vector<double> frequency;  ///< [Hz], from 0 to half the sampling rate, equally spaced
  std::vector<double> density;    ///< one-sided [X^2/Hz], one per frequency
  int segments = 0;               ///< how many were averaged
  double bin_width = 0;           ///< spacing of the frequencies [Hz]
  double noise_bandwidth = 0;     ///< equivalent noise bandwidth of the window [Hz]
};

/// A complex number per frequency: a transform or a transfer function.
struct ComplexSpectrum {
  std::vector<double> frequency;            ///< [Hz], equally spaced from 0
  std::vector<std::complex<double>> value;  ///< one per frequency
};

/// Power spectral density by averaged periodograms: Hann window (periodic), overlap of segment_length / 2 (rounded
/// down), the mean of each segment removed, one-sided, scaled to a density. A series shorter than one segment is one
/// segment; the result of fewer than two samples is empty.
///
/// sampling_rate   [Hz], > 0
/// segment_length  samples, >= 2
/// Source: Welch 1967, IEEE Trans. Audio Electroacoust. 15; conventions of scipy.signal.welch.
PowerSpectrum welch(std::span<const double> series, double sampling_rate, int segment_length);

/// Level of a pressure density: 10 log10(density / (20 uPa)^2) [dB re (20 uPa)^2/Hz], not below -300 dB.
std::vector<double> density_level(const PowerSpectrum& spectrum);

/// Sound pressure level 20 log10(rms / 20 uPa) [dB] of a pressure series [Pa]; the rms is taken about the mean, since a
/// constant pressure is no sound. Not below -300 dB.
double sound_pressure_level(std::span<const double> pressure);

/// Fourier integral of a transient, X(f) = dt sum_n x_n exp(-2 pi i f n dt) [unit of the series times s], without
/// window, padded with zeros until the bins are not wider than `bin_width` [Hz].
ComplexSpectrum transient_spectrum(std::span<const double> series, double sampling_rate, double bin_width);

/// Transfer function of a whole transient, H = R(f) / S(f), bins as in `transient_spectrum`. Not a number at
/// frequencies where |S| is below `source_floor` times its largest value: there the source says nothing.
ComplexSpectrum transient_transfer_function(std::span<const double> source, std::span<const double> response,
                                            double sampling_rate, double bin_width, double source_floor = 1e-4);

/// 20 log10 |H| [dB re 1 in the unit of H], not below -300 dB; not a number stays so.
std::vector<double> magnitude_level(const ComplexSpectrum& spectrum);

}  // namespace vocalis::acoustic
