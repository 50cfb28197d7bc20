#pragma once

#include <complex>
#include <span>
#include <vector>

namespace vocalis::acoustic {

/// A small matrix, column by column, for the signal processing of one rank.
struct DenseMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<double> values;

  DenseMatrix(int rows_, int columns_)
      : rows(rows_), columns(columns_), values(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)) {}
  double& operator()(int row, int column) { return values[index(row, column)]; }
  double operator()(int row, int column) const { return values[index(row, column)]; }

 private:
  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(column) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row);
  }
};

/// A = U diag(s) V^T with k = min(rows, columns): U is rows x k, s falls, V^T is k x columns.
struct SingularValues {
  DenseMatrix left;
  std::vector<double> values;  ///< empty if the iteration failed
  DenseMatrix right_transposed;
};

/// Singular value decomposition (LAPACK dgesdd).
SingularValues singular_values(DenseMatrix matrix);

/// R of A = Q R, min(rows, columns) x columns: the least squares of a tall system are those of R's (LAPACK dgeqrf).
DenseMatrix upper_triangle(DenseMatrix matrix);

/// Eigenvalues of a square matrix (LAPACK dgeev), in no stated order; empty if the iteration failed.
std::vector<std::complex<double>> eigenvalues(DenseMatrix matrix);

/// Roots of z^n + c[0] z^(n-1) + ... + c[n-1], as the eigenvalues of the companion matrix.
std::vector<std::complex<double>> polynomial_roots(std::span<const double> coefficients);

}  // namespace vocalis::acoustic
