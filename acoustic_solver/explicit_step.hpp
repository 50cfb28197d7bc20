#pragma once

#include <memory>

#include "acoustic_solver/moving_leap_frog.hpp"
#include "acoustic_solver/still_leap_frog.hpp"

namespace vocalis::acoustic {

/// Leap-frog for pressure and potential, with lumped mass, corrected so that errors of wave speed and of time are of
/// order 4 where cells are of equal shape. A sub-step goes half a step with ψ, a whole one with p, half a step with ψ:
/// both are known at the same times. It is stable below a step that the smallest cell sets. docs/theory.md, "Time of
/// sound".
class ExplicitStep {
 public:
  /// All must outlive the integrator.
  ExplicitStep(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, double density);

  /// The longest stable step [s] on the geometry that `wave` holds. Where the mesh stands still it comes from the
  /// largest eigenvalue, found once; where it moves, from a bound that is at most a third too short on sound cells. 0
  /// where a cell has no volume. Collective.
  double stable_step(bool moves);

  /// `step`, in `parts` equal parts. False, with the reason in the report, if the result is not finite: then the state
  /// is as before. Collective.
  bool advance(const SubStep& step, int parts, State& state, AdvanceReport& report);

  /// Forgets the rows of the geometry.
  void drop() { still_.reset(); }

  /// The assembled scheme on the geometry that `wave` holds. Collective where it is not yet assembled.
  StillLeapFrog& still();

 private:
  const mesh::Mesh* mesh_;
  const fem::Space* space_;
  const WaveOperator* wave_;
  double density_;
  std::unique_ptr<StillLeapFrog> still_;
  MovingLeapFrog moving_;
};

}  // namespace vocalis::acoustic
