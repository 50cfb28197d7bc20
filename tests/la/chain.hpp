#pragma once

#include <algorithm>
#include <vector>

#include "core/base/mpi.hpp"
#include "core/la/assembled_matrix.hpp"

namespace vocalis::la {

/// Points 0 .. 3 * ranks in a row, joined by springs of stiffness 1: rank r has the cells (3 r, 3 r + 1) and so on, and
/// the last point of a rank is the first of the next, which does not own it.
struct Chain {
  base::IndexMap points;
  SystemLayout layout;
  std::vector<PetscInt> rows;   ///< (3, 2)
  std::vector<double> springs;  ///< (3, 2, 2)

  Chain() {
    const int here = base::rank(MPI_COMM_WORLD), ranks = base::size(MPI_COMM_WORLD);
    // The lowest rank with a point owns it: rank 0 four points, the others three.
    points = base::contiguous_index_map(MPI_COMM_WORLD, here == 0 ? 4 : 3);
    if (here > 0) {
      points.ghost_global = {3 * here};
      points.ghost_owner = {here - 1};
    }
    layout = SystemLayout(MPI_COMM_WORLD, {{&points, 1}});
    for (int cell = 0; cell < 3; ++cell) {
      for (int end = 0; end < 2; ++end) {
        const int global = 3 * here + cell + end;
        const int local = here == 0 ? global : (global == 3 * here ? 3 : global - 3 * here - 1);
        rows.push_back(layout.global(0, local, 0));
      }
      springs.insert(springs.end(), {1, -1, -1, 1});
    }
    num_points = 3 * ranks + 1;
  }
  Chain(const Chain&) = delete;
  Chain& operator=(const Chain&) = delete;
  int num_points = 0;

  /// Owned positions of the chain's two ends, or of the first alone.
  std::vector<PetscInt> ends(bool both = true) const {
    std::vector<PetscInt> result;
    for (PetscInt i = 0; i < layout.num_owned(); ++i) {
      const PetscInt global = layout.offset() + i;
      if (global == 0 || (both && global == num_points - 1)) result.push_back(i);
    }
    return result;
  }
};

/// All rows of a matrix on every rank, dense.
inline std::vector<double> dense(Mat matrix, PetscInt n) {
  std::vector<double> mine(static_cast<std::size_t>(n) * n, 0.0), all(mine.size());
  PetscInt begin = 0, end = 0;
  base::check(MatGetOwnershipRange(matrix, &begin, &end));
  for (PetscInt row = begin; row < end; ++row) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const double* values = nullptr;
    base::check(MatGetRow(matrix, row, &count, &columns, &values));
    for (PetscInt i = 0; i < count; ++i) mine[row * n + columns[i]] = values[i];
    base::check(MatRestoreRow(matrix, row, &count, &columns, &values));
  }
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

}  // namespace vocalis::la
