#pragma once

#include <vector>

#include "contact/contact_search.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::coupling {

/// What contact has done so far, for summary.json.
struct ContactReport {
  double searches = 0;        ///< times that the distance from walls was solved
  double closings = 0;        ///< steps in which cells of the axis closed
  double closed_steps = 0;    ///< with cells in contact
  double repeated_steps = 0;  ///< taken again with half of dt because too much closed at once
  double energy_lost = 0;     ///< kinetic, of air caught in closing cells [J; in the plane J/m]
  double most_closed = 0;     ///< cells of the axis at once
  double seconds_open = 0;    ///< [s] wall time of contact in steps without closed cells, and ...
  double seconds_closed = 0;  ///< ... in steps with some
  double step_seconds_open = 0, step_seconds_closed = 0;  ///< [s] of all of these steps
};

/// Contact between the walls of a flow: proposes the phases of the next step from where a step ends, and gives them to
/// the flow before that step begins, so that they hold during the whole of it.
class ContactFollower {
 public:
  /// The flow must outlive it, and have FlowSettings::contact. Collective.
  ContactFollower(fsi::FsiSolver& flow, const contact::ContactSettings& settings);

  /// Gives the flow the phases found at the end of the last step. Collective.
  void begin_step();
  /// Looks at the step that the flow has tried and that converged: whether a cell would close from further away than
  /// half of where it is to, so that a shorter step is due. `reason` tells where no distance was found. Collective.
  struct Verdict {
    bool is_too_deep = false;
    std::string failure;
  };
  Verdict judge_step();
  /// The step was accepted: what was proposed holds from the next one on.
  void accept();
  void count_repeated_step() { ++report_.repeated_steps; }
  /// The coupled step took this long [s].
  void count_step(double seconds);

  const contact::ContactState& state() const { return state_; }
  const ContactReport& report() const { return report_; }
  /// Forgets everything that is kept for speed, so that the future depends on the state alone.
  void drop_caches();
  /// From a checkpoint.
  void set_state(const contact::ContactState& state, const ContactReport& report);

 private:
  fsi::FsiSolver& flow_;
  contact::ContactSearch search_;
  contact::ContactState state_;
  std::optional<contact::ContactProposal> proposal_;
  ContactReport report_;
  bool is_closed_ = false;  ///< in this step
  double seconds_ = 0;      ///< of contact in this step [s]
};

}  // namespace vocalis::coupling
