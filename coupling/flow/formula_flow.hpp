#pragma once

#include "coupling/flow/given_flow.hpp"

namespace vocalis::coupling {

/// A flow given by a formula, evaluated at the vertices of the flow mesh, which stands still. It takes the steps of the
/// case.
class FormulaFlow : public GivenFlow {
 public:
  /// The scene must outlive it.
  FormulaFlow(FlowFormula formula, const Scene& scene) : formula_(std::move(formula)), scene_(scene) {}

  double end() const override;
  double dt(const Clock& clock) const override { return clock.dt(); }
  FlowSnapshot snapshot(long steps, double time) const override;
  bool can_close() const override { return false; }

 private:
  FlowFormula formula_;
  const Scene& scene_;
};

}  // namespace vocalis::coupling
