#pragma once

#include <vector>

#include "core/la/petsc.hpp"
#include "core/la/system_layout.hpp"
#include "fsi_solver/cells/cell_input.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/mesh_motion/mesh_follower.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// The fields of a step that follow from its unknowns (v⁺, p, π): those at its end, and at the stage what the integrals
/// of cells are made of.
class StageFields {
 public:
  /// All references must outlive this; `motion` is null where nothing moves the fluid's mesh. Collective.
  StageFields(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
              const Prescribed& prescribed, MeshFollower* motion);

  /// The unknowns as one system: velocity, pressure, and with P1P1 the projected pressure gradient.
  const la::SystemLayout& layout() const { return layout_; }

  /// Takes the state, which must outlive the step, and sets velocity and pressure of the unknowns to where Newton's
  /// method starts: velocity extrapolated or not, essential values imposed, pressure as it was. An explicit geometry is
  /// found here. Collective.
  void begin_step(const State& state, const Stage& stage, Start start, Vec unknowns);
  /// Sets the velocity of the unknowns to a prediction of higher order, from which Newton's method has less to go. What
  /// is frozen during a step is better taken from the linear extrapolation, which does not amplify noise as much.
  void predict(Vec unknowns);
  /// All fields from the unknowns, ghosts current; an implicit mesh of the fluid follows the solids. Collective.
  void follow(Vec unknowns);
  /// The prescribed forces where the points are now; only needed for `inertia` of the cells.
  void find_forces();

  /// Fills the input of the integrals of a batch of cells from the stage.
  template <int D, int Degree>
  void gather(const CellBatches& batches, std::size_t batch, CellInput<D, Degree>& in) const;

  const Stage& stage() const { return stage_; }
  double stage_time() const { return state_->time + stage_.weight * stage_.dt; }  ///< [s]
  const fem::Field& end_velocity() const { return velocity_; }
  const fem::Field& end_displacement() const { return displacement_; }
  const fem::Field& pressure() const { return pressure_; }  ///< at the stage
  const std::vector<double>& stage_velocity() const { return stage_velocity_; }
  const std::vector<double>& stage_rate() const { return stage_rate_; }
  double offset_left() const { return offset_left_; }  ///< share of State::mesh_offset that is left at the end

 private:
  std::vector<double> end_coordinates() const;
  void impose_at_end(fem::Field& velocity) const;
  void move_solids();
  void move_fluid_mesh();
  void add_mesh_offset();
  void set_stage_geometry();
  template <int D, int Degree>
  void refer_to_closing(const CellBatches::Batch& batch, CellInput<D, Degree>& in) const;

  const Continuum& continuum_;
  const FlowSettings& settings_;
  const Conditions& conditions_;
  const Prescribed& prescribed_;
  MeshFollower* motion_;
  bool moves_, has_forces_;
  double offset_left_ = 0;

  la::SystemLayout layout_;
  const State* state_ = nullptr;
  Stage stage_;
  fem::Field velocity_, displacement_, pressure_, gradient_;  ///< at the end; p and π at the stage
  fem::Field mesh_displacement_;                              ///< of the vertices at the end, for the smoother
  std::vector<double> stage_velocity_, stage_rate_;           ///< (velocity dofs, dimension)
  std::vector<double> material_, grid_, grid_velocity_;       ///< d_s of solids, d_s and ∂t d of the fluid's mesh
  std::vector<double> fluid_force_, solid_force_;             ///< (velocity dofs, dimension), empty without forces
};

}  // namespace vocalis::fsi
