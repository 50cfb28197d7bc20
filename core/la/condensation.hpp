#pragma once

#include <dmumps_c.h>

#include <span>
#include <vector>

#include "core/la/petsc.hpp"

namespace vocalis::la {

/// Entries of a square matrix, in any order; indices from 0, those that stand twice are summed.
struct MatrixEntries {
  int size = 0;
  std::vector<int> rows, columns;
};

/// Eliminates all unknowns of a matrix on this rank but a few that are kept, by MUMPS: with e eliminated, k kept,
///
///     S = A_kk − A_ke A_ee⁻¹ A_ek,    r_k = b_k − A_ke A_ee⁻¹ b_e,    x_e = A_ee⁻¹ (b_e − A_ek x_k).
///
/// The same bit by bit in every run.
class Condensation {
 public:
  /// kept  indices; the order of S, r_k and x_k
  Condensation(const MatrixEntries& entries, std::span<const int> kept);
  ~Condensation();
  Condensation(const Condensation&) = delete;
  Condensation& operator=(const Condensation&) = delete;

  /// Of one factorisation, as far as is known before.
  double operations() const { return mumps_.rinfog[0]; }

  /// values  of the entries. Returns false if A_ee is singular or has pivots that are too small where they come up:
  /// they would be taken later, but not after what is kept.
  bool factorise(std::span<const double> values);
  /// S (kept, kept), row by row.
  std::span<double> kept_matrix() { return kept_matrix_; }

  /// load  (size) b; returns r_k, which may be changed into x_k in place for `expand`.
  std::span<double> condense(std::span<const double> load);
  /// x, after `condense`.
  std::span<const double> expand();

 private:
  void run(int job);

  DMUMPS_STRUC_C mumps_{};
  std::vector<int> rows_, columns_, kept_;  ///< from 1
  std::vector<double> values_, kept_matrix_, kept_load_, load_;
};

}  // namespace vocalis::la
