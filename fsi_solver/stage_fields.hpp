#pragma once

#include <vector>

#include "core/la/petsc.hpp"
#include "core/la/system_layout.hpp"
#include "fsi_solver/cell_terms.hpp"
#include "fsi_solver/conditions.hpp"
#include "fsi_solver/mesh_motion.hpp"
#include "fsi_solver/stage.hpp"

namespace vocalis::fsi {

/// The fields of a step that follow from its unknowns (v⁺, p, π): those at its end, and at the stage what the integrals
/// of a cell are made of.
class StageFields {
 public:
  /// All references must outlive this; `motion` is null where nothing moves the fluid's mesh. Collective.
  StageFields(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
              const Prescribed& prescribed, MeshMotion* motion);

  /// The unknowns as one system: velocity, pressure, projected pressure gradient.
  const la::SystemLayout& layout() const { return layout_; }

  /// Takes the state, which must outlive the step, and sets velocity and pressure of the unknowns to where Newton's
  /// method starts: velocity extrapolated, essential values imposed, pressure as it was. Collective.
  void begin_step(const State& state, const Stage& stage, Vec unknowns);
  /// All fields from the unknowns, ghosts current; the mesh of the fluid follows the solids. Collective.
  void follow(Vec unknowns);
  /// The prescribed forces where the points are now; only needed for `inertia` of the cells.
  void find_forces();

  /// Fills the input of a cell's integrals from the stage.
  template <int D>
  void gather(std::int32_t cell, CellInput<D>& in) const;

  const Stage& stage() const { return stage_; }
  double stage_time() const { return state_->time + stage_.weight * stage_.dt; }  ///< [s]
  const fem::Field& end_velocity() const { return velocity_; }
  const fem::Field& end_displacement() const { return displacement_; }
  const fem::Field& pressure() const { return pressure_; }  ///< at the stage

 private:
  std::vector<double> end_coordinates() const;

  const Continuum& continuum_;
  const FlowSettings& settings_;
  const Conditions& conditions_;
  const Prescribed& prescribed_;
  MeshMotion* motion_;
  bool moves_, has_forces_;

  la::SystemLayout layout_;
  const State* state_ = nullptr;
  Stage stage_;
  fem::Field velocity_, displacement_, pressure_, gradient_;  ///< at the end; p and π at the stage
  std::vector<double> stage_velocity_, stage_rate_, stage_displacement_, mesh_velocity_;  ///< (vertices, dimension)
  std::vector<double> fluid_force_, solid_force_;  ///< (vertices, dimension), empty without forces
};

}  // namespace vocalis::fsi
