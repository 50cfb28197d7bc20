#pragma once

#include <span>
#include <vector>

#include "core/la/petsc.hpp"
#include "core/la/system_layout.hpp"

namespace vocalis::la {

/// A sparse matrix whose entries are given cell by cell, always in the same order (PETSc's COO assembly): the sparsity
/// is found once, later assemblies only pass values.
///
/// Rows of constrained unknowns are left out of what the cells give, and get 1 on the diagonal; with
/// `drop_columns` their columns are left out too, which keeps a symmetric matrix symmetric.
class AssembledMatrix {
 public:
  /// rows_of_cell  (cells, n) global rows of each cell's unknowns; -1 leaves an unknown out
  /// n             unknowns a cell
  /// constrained   owned positions (0 .. num_owned) with an essential condition
  /// Collective.
  AssembledMatrix(const SystemLayout& layout, std::span<const PetscInt> rows_of_cell, int n,
                  std::span<const PetscInt> constrained, bool drop_columns = false);

  /// values  (cells, n, n), row by row: entry (i, j) of a cell's matrix belongs to row i. Collective.
  void assemble(std::span<const double> values);

  Mat get() const { return matrix_.get(); }

 private:
  PetscMatrix matrix_;
  std::vector<double> all_values_;  ///< the cells' values, then the diagonal of the constrained rows
  std::size_t num_cell_values_ = 0;
};

/// Marks constrained rows on every rank that sees them: global rows of constrained unknowns become known to other ranks
/// through a distributed marker vector. Returns for each of `rows` whether it is constrained. Collective.
std::vector<char> is_constrained(const SystemLayout& layout, std::span<const PetscInt> rows,
                                 std::span<const PetscInt> constrained);

}  // namespace vocalis::la
