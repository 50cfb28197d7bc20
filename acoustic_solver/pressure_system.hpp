#pragma once

#include <optional>
#include <span>
#include <vector>

#include "acoustic_solver/equal_order_matrix.hpp"
#include "acoustic_solver/layers.hpp"
#include "acoustic_solver/pressure_preconditioner.hpp"
#include "acoustic_solver/wave_operator.hpp"
#include "core/la/assembled_matrix.hpp"
#include "core/la/solve.hpp"

namespace vocalis::acoustic {

/// The symmetric positive definite system of a sub-step, a mass + admittance + b stiffness, with what layers add, and
/// its solver: conjugate gradients. The matrix is built anew when a, b or the geometry change; the preconditioner is
/// kept as long as it serves, since a moving mesh changes the matrix a little every step. Equal-order P1/P1 is solved
/// with the preconditioner of P1/P0.
class PressureSystem {
 public:
  /// Collective.
  PressureSystem(const mesh::Mesh& mesh, const fem::Space& space, const std::vector<std::int32_t>& constrained,
                 const AcousticSettings& settings);

  /// For the wave operator's geometry, of the sub-step that begins at `time` [s] if the mesh moves. Collective.
  ///
  /// is_solved_often  by several sounds
  void assemble(const WaveOperator& wave, const Layers& layers, double a, double b, double time, bool is_solved_often);
  bool is_assembled(double a, double b) const { return assembled_ && a == a_ && b == b_; }
  bool is_assembled(double a, double b, double time) const { return is_assembled(a, b) && time == time_; }
  void drop() { assembled_ = false; }

  /// Solves for the owned values. `solution` holds the starting guess on entry; constrained entries become 0.
  /// Collective.
  la::SolveReport solve(std::span<const double> right_hand_side, std::span<double> solution);

 private:
  /// Chooses the preconditioner, and creates the solver if there is none or its preconditioner is another.
  void prepare_solver(const WaveOperator& wave);
  la::SolveReport apply_factors();

  la::SystemLayout layout_;
  std::vector<std::int32_t> constrained_;
  double tolerance_, speed_of_sound_;
  int dimension_;
  std::int64_t num_unknowns_ = 0;  ///< of all ranks
  la::AssembledMatrix matrix_;     ///< of P1/P0
  std::optional<EqualOrderMatrix> equal_order_;
  la::PetscLinearSolver solver_;
  Preconditioner preconditioner_ = Preconditioner::incomplete;
  la::PetscVector right_hand_side_, solution_;
  std::vector<double> values_;
  double a_ = 0, b_ = 0, time_ = 0;
  bool assembled_ = false;
  bool is_exact_ = false;         ///< the preconditioner is the inverse
  bool rebuild_ = true;           ///< of the preconditioner, at the next assembly
  int iterations_when_new_ = -1;  ///< of the first solve with the present preconditioner; -1: not yet solved
};

}  // namespace vocalis::acoustic
