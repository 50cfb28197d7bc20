#pragma once

#include <deque>
#include <vector>

#include "coupling/analogies/flow_view.hpp"
#include "coupling/flow/flow_snapshot.hpp"
#include "coupling/flow/time_derivative.hpp"
#include "coupling/scene.hpp"

namespace vocalis::coupling {

/// What a voice follows in one step: the flow as its analogy sees it, and where the mesh moves.
struct FlowStep {
  FlowView view;
  fem::Field displacement_begin, displacement_end;  ///< P1 on the flow mesh [m], ghosts current
  std::vector<char> in_contact;                     ///< (owned cells of the flow mesh) during the step; empty: none
};

/// The last few snapshots of the flow, and the steps between them. What does not change (which cells are fluid by their
/// region, where the outlet and the walls are) is found once.
///
/// Cells in contact change between two steps, so that the pressure at the beginning of a step was computed with those
/// of the step before: cells that are or were in contact, anywhere among the snapshots that a rate is made of, are no
/// fluid in it.
class FlowHistory {
 public:
  /// `depth` snapshots are kept, see `snapshots_for`; `can_close` where cells can be in contact. The scene must outlive
  /// it.
  FlowHistory(const Scene& scene, int depth, bool can_close);

  /// Begins anew with one snapshot.
  void restart(FlowSnapshot snapshot);
  /// A step has led to `snapshot`.
  void add(FlowSnapshot snapshot);

  /// The latest step for which the derivative is known; it lies `lag_of(derivative)` steps back. Needs that `has_step`.
  /// Collective where cells can be in contact.
  FlowStep step(PressureDerivative derivative) const;
  bool has_step(PressureDerivative derivative) const;
  /// The flow where a voice with this derivative has come to: at the end of the latest `step`, or where all began.
  const FlowSnapshot& followed(PressureDerivative derivative) const;

  fem::Field displacement(const FlowSnapshot& snapshot) const;
  bool can_close() const { return can_close_; }

  const std::deque<FlowSnapshot>& snapshots() const { return snapshots_; }
  /// Those of a checkpoint, oldest first.
  void set_snapshots(std::deque<FlowSnapshot> snapshots) { snapshots_ = std::move(snapshots); }

 private:
  void leave_out_contact(FlowView& view, std::size_t first) const;

  const Scene& scene_;
  std::size_t depth_;
  bool can_close_;
  fem::Space space_;                         ///< P1 on the flow mesh
  std::vector<std::int32_t> cell_is_fluid_;  ///< (owned cells) by its region
  std::vector<mesh::NamedFacet> outlet_, walls_;
  std::deque<FlowSnapshot> snapshots_;  ///< oldest first
};

}  // namespace vocalis::coupling
