#pragma once

#include <algorithm>
#include <cmath>

#include "fsi_solver/cells/constitutive.hpp"

namespace vocalis::fsi::test {

template <int D>
Matrix<D> some_matrix(int seed, double size) {
  Matrix<D> m{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) m[i][j] = size * std::sin(1.0 + 3.7 * seed + 2.3 * i + 5.1 * j);
  }
  return m;
}

template <int D>
Matrix<D> sum(const Matrix<D>& a, double factor, const Matrix<D>& b) {
  Matrix<D> c{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) c[i][j] = a[i][j] + factor * b[i][j];
  }
  return c;
}

template <int D>
double largest(const Matrix<D>& a) {
  double result = 0;
  for (const auto& row : a) {
    for (const double value : row) result = std::max(result, std::abs(value));
  }
  return result;
}

}  // namespace vocalis::fsi::test
