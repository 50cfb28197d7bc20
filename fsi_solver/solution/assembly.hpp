#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "fsi_solver/solution/residual_size.hpp"
#include "fsi_solver/solution/stabilisation.hpp"
#include "fsi_solver/solution/stage_fields.hpp"

namespace vocalis::fsi {

/// The unknowns of a step as one system: residual and Jacobian. They are (v⁺, p), and with P1P1 π, the lumped
/// projection of the pressure gradient; kept as an unknown, it makes the stabilisation local to cells.
class Assembly {
 public:
  /// All references must outlive this. Collective.
  Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
           const Prescribed& prescribed, MeshFollower* motion);

  const la::SystemLayout& layout() const { return fields_.layout(); }
  Mat matrix() const { return matrix_->get(); }

  /// Sets the unknowns to where Newton's method starts, velocity extrapolated or not, essential values imposed, and
  /// freezes the step's stabilisation there. Collective.
  void begin_step(const State& state, const Stage& stage, Start start, Vec unknowns);
  /// Collective.
  ResidualSize residual(Vec unknowns, Vec result);
  /// At the unknowns of the last `residual`. Collective.
  void jacobian();

  /// Of the step that has begun.
  Stabilisation& stabilisation() { return stabilisation_; }
  const Stabilisation& stabilisation() const { return stabilisation_; }

  /// Results at the unknowns of the last `residual`.
  const StageFields& fields() const { return fields_; }
  /// Forces of the boundaries on each owned dof of the velocity [N], of essential conditions and of tractions, at the
  /// stage of the last `residual`; zero inside. Their product with the velocity is the power that they supply.
  const std::vector<double>& outer_forces() const { return outer_forces_; }
  /// The cell that is turned over most at the unknowns of the last `residual`: what it is of and where it rests, "of
  /// the fluid at rest at (0.1, 0.2) m". Collective.
  std::string worst_cell() const;

 private:
  void find_held_rows();
  void sort_tractions();
  std::vector<PetscInt> rows_of_cells() const;
  template <int D, int Degree>
  void sum_cells(ResidualSums& sums);
  template <int D, int Degree>
  void sum_tractions(ResidualSums& sums);
  void sum_over_ranks(ResidualSums& sums);
  template <int D, int Degree>
  void sum_jacobian();

  /// Facets of one boundary that are opposite to the same corner of fluid cells, or of one solid's.
  struct TractionBatches {
    int boundary = 0, facet = 0;
    CellBatches batches;
  };

  const Continuum& continuum_;
  const FlowSettings& settings_;
  const Conditions& conditions_;
  StageFields fields_;
  Stabilisation stabilisation_;
  std::vector<TractionBatches> tractions_;
  std::vector<PetscInt> held_rows_;  ///< owned positions with an essential value
  std::unique_ptr<la::AssembledMatrix> matrix_;
  std::vector<double> cell_matrices_;
  fem::Load momentum_, mass_, slope_, traction_;
  std::vector<double> outer_forces_;
  double smallest_determinant_ = 0;  ///< over this rank's cells, and which cell has it
  std::int32_t smallest_cell_ = -1;
};

}  // namespace vocalis::fsi
