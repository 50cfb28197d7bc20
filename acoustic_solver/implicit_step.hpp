#pragma once

#include <memory>
#include <vector>

#include "acoustic_solver/generalised_alpha.hpp"
#include "acoustic_solver/implicit_convection.hpp"
#include "acoustic_solver/layers.hpp"
#include "acoustic_solver/pressure_system.hpp"
#include "acoustic_solver/state.hpp"
#include "acoustic_solver/wave_operator.hpp"
#include "acoustic_solver/yielding_walls.hpp"

namespace vocalis::acoustic {

/// The generalised-α scheme for pressure and potential, both at the same times, with ψ eliminated: one symmetric
/// positive definite system a sub-step, whatever its length. The terms with β and U are iterated outside of it.
/// docs/theory.md, "Time of sound".
class ImplicitStep {
 public:
  /// All must outlive the integrator. Collective.
  ImplicitStep(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, const Layers& layers,
               const YieldingWalls& walls, const AcousticSettings& settings);

  /// One sub-step of the state, ghosts current before and after; `wave` holds the geometry at `stage_at`. False, with
  /// the reason in the report, if the system was not solved: then the state is as before. Collective.
  bool advance(const SubStep& step, State& state, AdvanceReport& report);

  /// Where the next sub-step wants load and geometry, as a part of it.
  double stage_at(const State& state) const { return scheme(state).at(); }
  /// Forgets matrix and preconditioner.
  void drop() {
    for (auto& system : systems_) system->drop();
  }

 private:
  /// Of the state's next sub-step: another one for the first.
  const GeneralisedAlpha& scheme(const State& state) const {
    return keeps_rates_ && !state.has_rates ? start_ : scheme_;
  }
  /// Finds the increment of p to the stage, from a guess of it.
  bool solve_step(const SubStep& step, PressureSystem& system, const std::vector<double>& fixed,
                  ImplicitConvection& convection, std::vector<double>& increment, AdvanceReport& report);
  /// Whether the difference is at most this part of the values, in the 2-norm. Collective.
  bool is_small(const std::vector<double>& difference, const std::vector<double>& values, double part) const;
  /// Assembled for the sub-step.
  PressureSystem& system_for(const SubStep& step, double beta);

  const mesh::Mesh* mesh_;
  const fem::Space* space_;
  const WaveOperator* wave_;
  const Layers* layers_;
  const YieldingWalls* walls_;
  AcousticSettings settings_;
  double density_, tolerance_;
  GeneralisedAlpha scheme_, start_;
  bool keeps_rates_;
  std::vector<std::unique_ptr<PressureSystem>> systems_;  ///< by SubStep::slot
};

}  // namespace vocalis::acoustic
