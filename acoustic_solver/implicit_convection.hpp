#pragma once

#include <vector>

#include "acoustic_solver/state.hpp"
#include "acoustic_solver/wave_operator.hpp"
#include "acoustic_solver/yielding_walls.hpp"

namespace vocalis::acoustic {

/// The terms with v = β - U of one sub-step of implicit Euler to the stage, which are iterated outside of the pressure
/// system. With r = v·∇ψ_θ the potential is ψ_θ = ψ* + θ dt (p_θ / ρ + r). A pass takes the last one's r to find p_θ,
/// and both for the new r. In a flow it leaves an error at most M + M² times as large as it finds, M the largest |U| /
/// c, whatever the step and the cells: docs/theory.md, "Sound in a flow".
class ImplicitConvection {
 public:
  /// beta       θ dt [s], see GeneralisedAlpha
  /// beginning  p* and ψ*
  /// All must outlive the object.
  ImplicitConvection(const fem::Space& space, const WaveOperator& wave, const YieldingWalls& walls, double density,
                     double beta, const Unknowns& beginning);

  /// p, but 0 at the inlets of the wave operator, where the rate of ψ is: what `increment` adds to.
  const std::vector<double>& base() const { return base_; }

  /// r for an increment of p to the stage, ghosts current, and the last r. Collective.
  void update(const std::vector<double>& increment);

  /// Whether the last update has changed ρ r, which p_θ answers to one to one at the most, by no more than this part of
  /// p_θ (2-norms). Collective.
  bool has_settled(double tolerance) const;

  /// Adds what the last r and p bring to the right-hand side, at the owners. Collective.
  void add_terms(std::vector<double>& right_hand_side) const;

  /// p_θ (0 at inlets) and ψ_θ for an increment and the last r.
  void at_stage(const std::vector<double>& increment, std::vector<double>& pressure,
                std::vector<double>& potential) const;

  /// Puts p_θ and ψ_θ into the unknowns, which may be those of the beginning.
  void finish(const std::vector<double>& increment, Unknowns& stage) const;

 private:
  const fem::Space* space_;
  const WaveOperator* wave_;
  const YieldingWalls* walls_;
  const Unknowns* beginning_;
  double density_, beta_;
  std::vector<double> base_;       ///< [Pa]
  std::vector<double> rates_;      ///< r [m^2/s^2]; empty before the first update
  std::vector<double> before_;     ///< r of the update before
  std::vector<double> held_;       ///< r, but 0 at inlets
  std::vector<double> convected_;  ///< p_θ that v carries
};

}  // namespace vocalis::acoustic
