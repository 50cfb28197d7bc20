#pragma once

#include <array>
#include <complex>

#include "tests/analogies/exact_sound.hpp"

namespace vocalis::coupling::test {

/// f_n of an f(θ) = Σ f_n e^{2inθ}: both vortices are alike.
struct Parts {
  static constexpr int highest = 6;
  std::array<std::complex<double>, 2 * highest + 1> values = {};
  const std::complex<double>& operator()(int n) const { return values[n + highest]; }
};

/// Functions of θ at one r, in the frame that turns with the pair: D/Dt = around ∂θ + outwards ∂r, by products of the
/// two [1/s; m/s], and a source, whose load on η e^{imθ} is ∫ -im η along + ∂r η across + η aside.
struct Ring {
  Parts around_around, around_outwards, outwards_outwards;
  Parts along, across, aside;
};

/// Whose source, whose operator.
struct TurningWaves {
  bool is_ape = false;     ///< Lamb vector and mean swirl; otherwise -w Dp/Dt / (ρ c²) and the whole flow, `pcwe`
  bool convection = true;  ///< in the operator
  SourceWindow window;
};

Ring ring_at(const SpinningPair& pair, const TurningWaves& waves, double r);

}  // namespace vocalis::coupling::test
