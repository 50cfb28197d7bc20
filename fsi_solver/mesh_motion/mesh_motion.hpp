#pragma once

#include <memory>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "core/la/solve.hpp"
#include "fsi_solver/conditions.hpp"

namespace vocalis::fsi {

/// Carries the displacement of the solids into the fluid's mesh: linear elasticity (ν = 0.3) on the reference, whose
/// stiffness is (mean volume / cell volume)^stiffening, so that small cells stay rigid. Linear and without memory: the
/// mesh comes back whenever the solids do. Factored once.
/// Source: Stein, Tezduyar, Benney 2003, J. Appl. Mech. 70, 58 (Jacobian-based stiffening).
class MeshMotion {
 public:
  /// Collective.
  MeshMotion(const Continuum& continuum, const Conditions& conditions, double stiffening);

  /// displacement  at vertices of solids given (owned ones suffice), elsewhere found; ghosts current on exit.
  /// Collective. Returns how the linear solve ended.
  la::SolveReport extend(fem::Field& displacement);

 private:
  const Continuum& continuum_;
  la::SystemLayout layout_;
  std::vector<char> constrained_;  ///< (owned vertices, dimension)
  std::unique_ptr<la::AssembledMatrix> matrix_;
  la::PetscLinearSolver solver_;
  la::PetscVector right_hand_side_, solution_;
};

}  // namespace vocalis::fsi
