#pragma once

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/la/petsc.hpp"

namespace vocalis::la {

/// A number in (-1, 1) that goes with two others.
inline double noise(PetscInt i, PetscInt j) {
  const double large = 43758.5453 * std::sin(12.9898 * static_cast<double>(i) + 78.233 * static_cast<double>(j));
  return 2 * (large - std::floor(large)) - 1;
}

/// A strip of 6 points across and `along` on each rank, u and p at each, ordered rank by rank: (u, p) couples with the
/// 9 points around, and nothing is symmetric; with `constraints` the block of p is empty. One row is that of the
/// identity.
struct Strip {
  static constexpr int across = 6, fields = 2;
  int along;
  bool has_constraints;
  PetscInt rows_of_rank = static_cast<PetscInt>(along) * across * fields;
  PetscInt rows = rows_of_rank * base::size(MPI_COMM_WORLD), begin = rows_of_rank * base::rank(MPI_COMM_WORLD);
  PetscMatrix matrix;

  explicit Strip(int points_along, bool constraints = false) : along(points_along), has_constraints(constraints) {
    base::check(MatCreateAIJ(MPI_COMM_WORLD, rows_of_rank, rows_of_rank, PETSC_DETERMINE, PETSC_DETERMINE, 18, nullptr,
                             18, nullptr, matrix.put()));
    fill(1);
  }
  void fill(double factor) {
    const PetscInt column_of_points = across * fields, held = column_of_points + 1;
    for (PetscInt row = begin; row < begin + rows_of_rank; ++row) {
      const PetscInt point = row / fields, x = point / across, y = point % across;
      for (PetscInt i = std::max<PetscInt>(0, x - 1); i <= std::min(rows / column_of_points - 1, x + 1); ++i) {
        for (PetscInt j = std::max<PetscInt>(0, y - 1); j <= std::min<PetscInt>(across - 1, y + 1); ++j) {
          for (int field = 0; field < fields && row != held; ++field) {
            const PetscInt column = (i * across + j) * fields + field;
            const bool is_constraint = has_constraints && row % fields == 1 && field == 1;
            const double value = (row == column ? 4 : 0) + noise(row, column);
            base::check(MatSetValue(matrix.get(), row, column, is_constraint ? 0 : factor * value, INSERT_VALUES));
          }
        }
      }
      if (row == held) base::check(MatSetValue(matrix.get(), row, row, 1, INSERT_VALUES));
    }
    base::check(MatAssemblyBegin(matrix.get(), MAT_FINAL_ASSEMBLY));
    base::check(MatAssemblyEnd(matrix.get(), MAT_FINAL_ASSEMBLY));
  }
  /// |A x - b| / (|A| |x| + |b|) with what `solve(b, x)` gives.
  template <class Solve>
  double residual(const Solve& solve) const {
    const PetscVector b = create_vector(MPI_COMM_WORLD, rows_of_rank), x = create_vector(MPI_COMM_WORLD, rows_of_rank);
    {
      const OwnedValues values(b.get());
      for (PetscInt i = 0; i < rows_of_rank; ++i) values[i] = noise(begin + i, 7);
    }
    solve(b.get(), x.get());
    PetscReal of_matrix = 0, of_x = 0, of_b = 0, left = 0;
    base::check(MatNorm(matrix.get(), NORM_FROBENIUS, &of_matrix));
    base::check(VecNorm(x.get(), NORM_2, &of_x));
    base::check(VecNorm(b.get(), NORM_2, &of_b));
    base::check(VecScale(b.get(), -1));
    base::check(MatMultAdd(matrix.get(), x.get(), b.get(), b.get()));
    base::check(VecNorm(b.get(), NORM_2, &left));
    return left / (of_matrix * of_x + of_b);
  }
};

}  // namespace vocalis::la
