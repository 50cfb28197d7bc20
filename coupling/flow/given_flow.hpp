#pragma once

#include <memory>

#include "coupling/clock.hpp"
#include "coupling/flow/flow_snapshot.hpp"
#include "coupling/flow/given_flow_settings.hpp"
#include "coupling/scene.hpp"

namespace vocalis::coupling {

/// A flow that is not solved. It says which steps it takes and what it is after each; whoever follows its snapshots
/// cannot tell it from one that is solved.
class GivenFlow {
 public:
  virtual ~GivenFlow() = default;

  /// Up to when it is known [s].
  virtual double end() const = 0;
  /// The step that it takes now [s].
  virtual double dt(const Clock& clock) const = 0;
  /// Itself after so many steps, at that time [s]. Collective.
  virtual FlowSnapshot snapshot(long steps, double time) const = 0;
  /// Whether cells of its mesh can be in contact.
  virtual bool can_close() const = 0;
};

/// The scene must outlive it. Throws UserError for a record that cannot be read, or is of another mesh. Collective.
std::unique_ptr<GivenFlow> make_given_flow(const GivenFlowSettings& settings, const Scene& scene);

}  // namespace vocalis::coupling
