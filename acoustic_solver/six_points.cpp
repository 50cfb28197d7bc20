#include "acoustic_solver/six_points.hpp"

namespace vocalis::acoustic {

namespace {

std::array<std::array<double, six>, six> expanded() {
  std::array<std::array<double, six>, six> powers{};
  for (int i = 0; i < six; ++i) {
    powers[i][0] = 1;
    int degree = 0;
    for (int j = 0; j < six; ++j) {
      if (j == i) continue;
      // Times (f - x_j) / (x_i - x_j).
      ++degree;
      for (int k = degree; k >= 0; --k) {
        const double lower = k > 0 ? powers[i][k - 1] : 0;
        powers[i][k] = (lower - (j - 2) * powers[i][k]) / (i - j);
      }
    }
  }
  return powers;
}

}  // namespace

std::array<double, six> six_point_weights(const std::array<double, six>& nodes, double x) {
  std::array<double, six> weights;
  for (int i = 0; i < six; ++i) {
    weights[i] = 1;
    for (int j = 0; j < six; ++j) {
      if (j != i) weights[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
    }
  }
  return weights;
}

const std::array<std::array<double, six>, six>& six_point_powers() {
  static const auto powers = expanded();
  return powers;
}

}  // namespace vocalis::acoustic
