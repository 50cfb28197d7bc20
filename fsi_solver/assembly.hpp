#pragma once

#include <memory>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "fsi_solver/residual_size.hpp"
#include "fsi_solver/stabilisation.hpp"
#include "fsi_solver/stage_fields.hpp"

namespace vocalis::fsi {

/// The unknowns (v⁺, p, π) of a step as one system: residual and Jacobian. π is the lumped projection of the pressure
/// gradient; kept as an unknown, it makes the stabilisation local to cells.
class Assembly {
 public:
  /// All references must outlive this. Collective.
  Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
           const Prescribed& prescribed, MeshMotion* motion);

  const la::SystemLayout& layout() const { return fields_.layout(); }
  Mat matrix() const { return matrix_->get(); }

  /// Sets the unknowns to where Newton's method starts, velocity extrapolated and essential values imposed, and freezes
  /// the step's stabilisation there. Collective.
  void begin_step(const State& state, const Stage& stage, Vec unknowns);
  /// Collective.
  ResidualSize residual(Vec unknowns, Vec result);
  /// At the unknowns of the last `residual`. Collective.
  void jacobian();

  /// Of the step that has begun.
  Stabilisation& stabilisation() { return stabilisation_; }

  /// Results at the unknowns of the last `residual`.
  const fem::Field& end_velocity() const { return fields_.end_velocity(); }
  const fem::Field& end_displacement() const { return fields_.end_displacement(); }
  const fem::Field& pressure() const { return fields_.pressure(); }

 private:
  void find_held_rows();
  std::vector<PetscInt> rows_of_cells() const;
  template <int D>
  void sum_cells(ResidualSums& sums);
  template <int D>
  void sum_tractions(ResidualSums& sums);
  void sum_over_ranks(ResidualSums& sums);
  template <int D>
  void sum_jacobian();

  const Continuum& continuum_;
  const FlowSettings& settings_;
  const Conditions& conditions_;
  StageFields fields_;
  Stabilisation stabilisation_;
  std::vector<PetscInt> held_rows_;  ///< owned positions with an essential value
  std::unique_ptr<la::AssembledMatrix> matrix_;
  std::vector<double> cell_matrices_;
  fem::Load momentum_, mass_, slope_;
};

}  // namespace vocalis::fsi
