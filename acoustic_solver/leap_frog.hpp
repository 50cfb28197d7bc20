#pragma once

#include <cmath>

namespace vocalis::acoustic {

/// Part of the consistent mass in the mass of an explicit step: errors of wave speed by lumped and consistent mass are
/// of opposite signs, as 1 to 1 in the plane and 1 to 2 in space, and cancel up to order 4 on cells of equal shape.
constexpr double consistent_part(int dimension) { return dimension == 2 ? 0.5 : 1.0 / 3; }

/// The largest stable λ dt² of the corrected leap-frog, λ the largest eigenvalue of (lumped mass)⁻¹ stiffness / ρ
/// [1/s²]: the smaller root of  (1 + γ (1 - 1 / (d + 2))) x - x² / 12 = 4, since a cell's consistent mass is nowhere
/// below 1 / (d + 2) of its lumped one. Without corrections it is 4.
inline double stable_product(int dimension) {
  const double s = 1 + consistent_part(dimension) * (1 - 1.0 / (dimension + 2));
  return 6 * (s - std::sqrt(s * s - 4.0 / 3));
}

}  // namespace vocalis::acoustic
