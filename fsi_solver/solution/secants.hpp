#pragma once

#include <vector>

#include "core/la/petsc.hpp"

namespace vocalis::fsi {

/// Broyden's good update of a kept Jacobian's inverse from the steps that were taken and what they did to the residual:
/// it learns what the Jacobian leaves out (the mesh that follows the solids) or has grown old in. With B₀⁻¹ the kept
/// factors, s_j a step and z_j = -B_j⁻¹ F after it,
///
///   B_{j+1}⁻¹ = (I + w_j s_jᵀ) B_j⁻¹,   w_j = z_j / (s_jᵀ (s_j - z_j))
///
/// Products are taken over the first entries of a vector alone, those of the velocity: what enters the equations
/// linearly needs no learning, and the units of all entries are the same.
/// Source: Broyden 1965, Math. Comput. 19, 577; Kelley 1995, Iterative Methods for Linear and Nonlinear Equations, 7.3.
class Secants {
 public:
  /// first_entries  number of owned entries that products are taken over
  /// most           pairs kept; when there are more, all are forgotten
  Secants(MPI_Comm comm, PetscInt first_entries, int most);

  /// Forgets everything: for a new Jacobian.
  void clear();
  /// The next `improve` begins another solve: no step leads to it.
  void begin_solve() { has_step_ = false; }
  /// change  on entry B₀⁻¹ F at the present iterate, on exit what Newton's method subtracts from it. Collective.
  void improve(Vec change);

 private:
  double product(Vec a, Vec b) const;
  struct Pair {
    la::PetscVector step, weight;
  };
  MPI_Comm comm_;
  PetscInt first_entries_;
  std::size_t most_;
  std::size_t count_ = 0;    ///< pairs in use
  std::vector<Pair> pairs_;  ///< kept for reuse
  la::PetscVector step_;     ///< the last one
  bool has_step_ = false;
};

}  // namespace vocalis::fsi
