#pragma once

#include <array>

namespace vocalis::acoustic {

inline constexpr int six = 6;

/// Weights of six values at the given nodes for the value at x of the polynomial of degree five through them
/// (Lagrange).
std::array<double, six> six_point_weights(const std::array<double, six>& nodes, double x);

/// Coefficients [node][power] of the same for the nodes -2, -1, 0, 1, 2, 3: the weight of node i at f is the sum over
/// powers of [i][power] f^power. The interpolation serves 0 <= f <= 1, in the middle.
const std::array<std::array<double, six>, six>& six_point_powers();

}  // namespace vocalis::acoustic
