#include "acoustic_solver/signals/dense.hpp"

#include <algorithm>
#include <cassert>
#include <cstddef>

// LAPACK, Fortran interface. The last arguments are the lengths of the character arguments, which Fortran expects.
extern "C" {
void dgesdd_(const char* job, const int* rows, const int* columns, double* matrix, const int* leading, double* values,
             double* left, const int* leading_left, double* right, const int* leading_right, double* work,
             const int* work_size, int* integer_work, int* info, std::size_t);
void dgeqrf_(const int* rows, const int* columns, double* matrix, const int* leading, double* scales, double* work,
             const int* work_size, int* info);
void dgeev_(const char* job_left, const char* job_right, const int* size, double* matrix, const int* leading,
            double* real, double* imaginary, double* left, const int* leading_left, double* right,
            const int* leading_right, double* work, const int* work_size, int* info, std::size_t, std::size_t);
}

namespace vocalis::acoustic {

SingularValues singular_values(DenseMatrix matrix) {
  const int count = std::min(matrix.rows, matrix.columns);
  SingularValues result{DenseMatrix(matrix.rows, count), std::vector<double>(static_cast<std::size_t>(count)),
                        DenseMatrix(count, matrix.columns)};
  if (count == 0) return result;
  std::vector<int> integer_work(static_cast<std::size_t>(8 * count));
  int info = 0;
  const auto run = [&](double* work, int work_size) {
    dgesdd_("S", &matrix.rows, &matrix.columns, matrix.values.data(), &matrix.rows, result.values.data(),
            result.left.values.data(), &matrix.rows, result.right_transposed.values.data(), &count, work, &work_size,
            integer_work.data(), &info, 1);
  };
  double wanted = 0;
  run(&wanted, -1);
  std::vector<double> work(static_cast<std::size_t>(wanted));
  run(work.data(), static_cast<int>(work.size()));
  if (info != 0) result.values.clear();
  return result;
}

DenseMatrix upper_triangle(DenseMatrix matrix) {
  const int count = std::min(matrix.rows, matrix.columns);
  DenseMatrix result(count, matrix.columns);
  if (count == 0) return result;
  std::vector<double> scales(static_cast<std::size_t>(count));
  int info = 0;
  const auto run = [&](double* work, int work_size) {
    dgeqrf_(&matrix.rows, &matrix.columns, matrix.values.data(), &matrix.rows, scales.data(), work, &work_size, &info);
  };
  double wanted = 0;
  run(&wanted, -1);
  std::vector<double> work(static_cast<std::size_t>(wanted));
  run(work.data(), static_cast<int>(work.size()));
  assert(info == 0);
  for (int column = 0; column < matrix.columns; ++column) {
    for (int row = 0; row <= std::min(column, count - 1); ++row) result(row, column) = matrix(row, column);
  }
  return result;
}

std::vector<std::complex<double>> eigenvalues(DenseMatrix matrix) {
  assert(matrix.rows == matrix.columns);
  const int size = matrix.rows;
  std::vector<std::complex<double>> result;
  if (size == 0) return result;
  std::vector<double> real(static_cast<std::size_t>(size));
  std::vector<double> imaginary(static_cast<std::size_t>(size));
  const int one = 1;
  int info = 0;
  const auto run = [&](double* work, int work_size) {
    dgeev_("N", "N", &size, matrix.values.data(), &size, real.data(), imaginary.data(), nullptr, &one, nullptr, &one,
           work, &work_size, &info, 1, 1);
  };
  double wanted = 0;
  run(&wanted, -1);
  std::vector<double> work(static_cast<std::size_t>(wanted));
  run(work.data(), static_cast<int>(work.size()));
  if (info != 0) return result;
  for (std::size_t i = 0; i < real.size(); ++i) result.emplace_back(real[i], imaginary[i]);
  return result;
}

std::vector<std::complex<double>> polynomial_roots(std::span<const double> coefficients) {
  const int degree = static_cast<int>(coefficients.size());
  DenseMatrix companion(degree, degree);
  for (int i = 0; i < degree; ++i) {
    companion(0, i) = -coefficients[static_cast<std::size_t>(i)];
    if (i > 0) companion(i, i - 1) = 1;
  }
  return eigenvalues(companion);
}

}  // namespace vocalis::acoustic
