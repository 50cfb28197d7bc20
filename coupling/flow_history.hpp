#pragma once

#include <vector>

#include "coupling/analogies/flow_view.hpp"
#include "coupling/scene.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::coupling {

/// Turns two consecutive states of the flow into what an analogy sees. What does not change from step to step (which
/// cells are fluid by their region, where the outlet is, which pressure belongs to a vertex) is found once.
///
/// Cells in contact change between two steps, so that the pressure at the beginning of a step was computed with those
/// of the step before: cells that were or are in contact are no fluid in it.
class FlowHistory {
 public:
  /// Scene and solver must outlive it.
  FlowHistory(const Scene& scene, const fsi::FsiSolver& flow);

  /// Keeps the flow's present state as the beginning of the next step. Collective.
  void begin_step();
  /// The step is over, and cells in contact may change. Also to be called after the flow's state was replaced.
  void end_step() { contact_before_ = flow_.state().in_contact; }
  /// The step from there to the flow's present state.
  FlowView view() const;

  /// Displacement of the vertices [m], at the beginning and the end.
  const fem::Field& displacement_begin() const { return displacement_begin_; }
  fem::Field displacement_end() const;

 private:
  std::vector<double> vertex_pressure() const;
  void leave_out_contact();

  const Scene& scene_;
  const fsi::FsiSolver& flow_;
  fem::Space space_;                         ///< P1 on the flow mesh
  std::vector<std::int32_t> cell_is_fluid_;  ///< (owned cells) by its region
  std::vector<mesh::NamedFacet> outlet_;
  std::vector<std::int32_t> vertex_to_pressure_;  ///< dof of the fluid's pressure, or -1
  std::vector<char> contact_before_;              ///< (owned cells) in contact in the step before; empty: none
  std::vector<std::int32_t> cell_emits_, vertex_is_silent_;  ///< see FlowView
  double time_begin_ = 0;
  std::vector<double> pressure_begin_, velocity_begin_;
  fem::Field displacement_begin_;
};

}  // namespace vocalis::coupling
