#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "acoustic_solver/pulse.hpp"
#include "core/base/timers.hpp"
#include "coupling/clock.hpp"
#include "coupling/contact_follower.hpp"
#include "coupling/far_field/surface_microphones.hpp"
#include "coupling/flow/flow_history.hpp"
#include "coupling/flow/given_flow.hpp"
#include "coupling/flow/solved_flow.hpp"
#include "coupling/monitors/monitors.hpp"
#include "coupling/scene.hpp"
#include "coupling/voice/voice.hpp"

namespace vocalis::coupling {

/// What one step did, for history.csv and the progress line.
struct StepOutcome {
  std::string failure;  ///< empty: the step was accepted
  double dt = 0;        ///< [s]
  int newton_iterations = 0;
  int jacobians = 0;            ///< factorised by the flow
  double local_error = 0;       ///< of the flow's step, relative; 0: not known
  int acoustic_iterations = 0;  ///< of all acoustic solvers
  double smallest_quality = 1;  ///< of the moved mesh
};

/// All parts of one run, and the step that couples them: the flow moves first, on its own; the air follows it; then
/// each acoustic solver takes its source from the flow's step and sub-steps to the same time. Coupling is one-way. A
/// flow that is given takes the place of one that is solved.
class Simulation {
 public:
  /// The scene must outlive the simulation. Throws UserError for what the meshes do not have. Collective.
  Simulation(Scene& scene, const Case& config, base::Timers& timers);

  /// Takes one accepted step, shrinking dt until the flow converges. Collective.
  StepOutcome step();

  const Clock& clock() const { return clock_; }
  void set_clock(const Clock& clock) { clock_ = clock; }
  const Monitors* monitors() const { return monitors_.get(); }
  Monitors* monitors() { return monitors_.get(); }
  std::vector<double> monitor_values() const;
  /// The flow that is solved; null without one.
  const fsi::FsiSolver* flow() const { return flow_.get(); }
  fsi::FsiSolver* flow() { return flow_.get(); }
  const ContactFollower* contact() const { return contact_.get(); }
  ContactFollower* contact() { return contact_.get(); }
  std::vector<std::unique_ptr<Voice>>& voices() { return voices_; }
  const std::vector<std::unique_ptr<Voice>>& voices() const { return voices_; }
  /// Null without such microphones.
  SurfaceMicrophones* surface_microphones() { return surface_microphones_.get(); }
  const std::optional<acoustic::PulseFlux>& source() const { return source_; }
  /// The flow's last snapshots; none without a flow.
  const std::optional<FlowHistory>& history() const { return history_; }
  std::optional<FlowHistory>& history() { return history_; }
  /// The flow at the time of the clock. Collective.
  FlowSnapshot flow_now() const { return flow_after(clock_.step, clock_.time); }

  /// After this the future depends on the states alone, to the last bit: called at every scheduled checkpoint, in runs
  /// that are never stopped, too.
  void drop_caches();
  /// Lets the voices follow the flow's cells in contact where the flow's last snapshots were replaced, before the
  /// states of voices are. Collective.
  void follow_contact();
  /// After the states were replaced by those of a checkpoint.
  void restart_from_states();

 private:
  void begin_flow(const Case& config);
  FlowSnapshot flow_after(long steps, double time) const;
  void begin_contact();
  StepOutcome step_flow();
  bool try_flow_step(StepOutcome& outcome);
  void step_surfaces();
  void step_voices(double dt, StepOutcome& outcome);
  const Voice* voice_beside(const Case& config, const acoustic::AcousticSettings& settings) const;

  Scene& scene_;
  base::Timers& timers_;
  Clock clock_;
  std::unique_ptr<fsi::FsiSolver> flow_;
  std::unique_ptr<ContactFollower> contact_;  ///< null where walls cannot touch
  std::optional<SolvedFlow> solved_;
  std::unique_ptr<GivenFlow> given_;  ///< instead of flow_; no more than one of both is there
  std::optional<FlowHistory> history_;
  std::unique_ptr<SurfaceMicrophones> surface_microphones_;  ///< null without such microphones
  std::unique_ptr<Monitors> monitors_;
  std::optional<acoustic::PulseFlux> source_;
  std::vector<std::unique_ptr<Voice>> voices_;
};

}  // namespace vocalis::coupling
