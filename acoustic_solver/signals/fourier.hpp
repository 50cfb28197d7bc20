#pragma once

#include <complex>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// Discrete Fourier transform of a real series, padded with zeros (or cut) to `length`:
///
///   X_k = sum_n x_n exp(-2 pi i k n / length),   k = 0 .. length / 2
///
/// returns  length / 2 + 1 numbers in the unit of the series, not scaled
std::vector<std::complex<double>> fourier_transform(std::span<const double> series, int length);

/// The inverse of `fourier_transform`: `length` real numbers from length / 2 + 1 complex ones, scaled by 1 / length.
std::vector<double> inverse_fourier_transform(std::span<const std::complex<double>> spectrum, int length);

/// The least power of two that is not below `count`.
int padded_length(double count);

}  // namespace vocalis::acoustic
