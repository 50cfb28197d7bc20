#pragma once

#include <memory>
#include <vector>

#include "core/la/assembled_matrix.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/mesh_motion.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// Stabilisation of every cell for one step, from the accepted state: τ, τ₂, the advecting velocity and the projection
/// of (c·∇)v at the stage by extrapolation from the last two steps, so that it is second order in time and needs no
/// memory.
///
///   1/τ = ρ Σ_a |c·∇φ_a| + µ Σ_a |∇φ_a|²   in the stream,   1/τ = ρ |c| (Σ_a |∇φ_a|²)^½ + µ Σ_a |∇φ_a|² of the
///   pressure (solids: c → c_s = (µs / ρs)^½, µ → η),   τ₂ = µ + ρ |c| / (Σ_a |∇φ_a|²)^½
///
/// These are 2 ρ |c| / h and 4 µ / h² of a regular triangle. No dt enters, so nothing collapses as dt → 0.
/// Source: Codina 2000, Comput. Meth. Appl. Mech. Eng. 190, 1579; 2008, Appl. Numer. Math. 58, 264 (term by term).
struct Stabilisation {
  std::vector<double> pressure, stream, divergence;  ///< (cells)
  std::vector<double> recovery;                      ///< (cells) κ of incompressible solids [1/s]
  std::vector<double> advection, projection;         ///< (cells, dimension)
};

/// How far the equations are from being solved: the largest, over fields and regions, of |residual| / |cells' terms|.
struct ResidualSize {
  double error = 0;
  bool inverted = false;  ///< some cell has no positive volume at the stage; `error` is then meaningless
};

/// The unknowns (v⁺, p, π) of a step as one system: residual and Jacobian. π is the lumped projection of the pressure
/// gradient; kept as an unknown, it makes the stabilisation local to cells.
class Assembly {
 public:
  /// All references must outlive this. Collective.
  Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
           const Prescribed& prescribed, MeshMotion* motion);

  const la::SystemLayout& layout() const { return layout_; }
  Mat matrix() const { return matrix_->get(); }

  /// Sets the unknowns to where Newton's method starts, velocity extrapolated and essential values imposed, and freezes
  /// the step's stabilisation there. Collective.
  void begin_step(const State& state, const Stage& stage, Vec unknowns);
  /// Collective.
  ResidualSize residual(Vec unknowns, Vec result);
  /// At the unknowns of the last `residual`. Collective.
  void jacobian();

  /// Results at the unknowns of the last `residual`.
  const fem::Field& end_velocity() const { return velocity_; }
  const fem::Field& end_displacement() const { return displacement_; }
  const fem::Field& pressure() const { return pressure_; }

 private:
  void first_guess(Vec unknowns) const;
  void follow(Vec unknowns);
  void find_forces();
  template <int D>
  void stabilise();
  template <int D>
  ResidualSize sum_residual();
  template <int D>
  void sum_jacobian();
  template <int D, class Cell>
  void gather(std::int32_t cell, Cell& in) const;

  const Continuum& continuum_;
  const FlowSettings& settings_;
  const Conditions& conditions_;
  const Prescribed& prescribed_;
  MeshMotion* motion_;
  bool moves_, has_forces_;

  la::SystemLayout layout_;
  std::unique_ptr<la::AssembledMatrix> matrix_;
  std::vector<double> cell_matrices_;
  std::vector<PetscInt> held_rows_;  ///< owned positions with an essential value

  const State* state_ = nullptr;
  Stage stage_;
  Stabilisation stabilisation_;
  fem::Field velocity_, displacement_, pressure_, gradient_;  ///< at the end; p and π at the stage
  std::vector<double> stage_velocity_, stage_rate_, stage_displacement_, mesh_velocity_;  ///< (vertices, dimension)
  std::vector<double> fluid_force_, solid_force_;  ///< (vertices, dimension), empty without forces
  fem::Load momentum_, mass_, slope_;
};

}  // namespace vocalis::fsi
