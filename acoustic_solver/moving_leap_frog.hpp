#pragma once

#include <vector>

#include "acoustic_solver/lumped_terms.hpp"
#include "acoustic_solver/state.hpp"

namespace vocalis::acoustic {

/// The explicit scheme on a mesh that moves: loops over the cells, with the geometry of the middle of each sub-step.
/// The terms with β are those of `WaveOperator`, iterated towards the middle of the step.
class MovingLeapFrog {
 public:
  /// All must outlive it. Collective.
  MovingLeapFrog(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, double density);

  /// `parts` equal sub-steps of `step`, whose `place` moves the geometry of `wave`. False, with the state as before, if
  /// the result is not finite. Collective.
  bool advance(const SubStep& step, int parts, State& state);

 private:
  void sub_step(double dt, std::span<const double> load, double flux, State& state);
  /// The change of p that the sums on its right-hand side make, at the owners and their ghosts.
  std::vector<double> increment(std::vector<double> sums, const LumpedTerms& terms, double dt) const;
  /// ψ at the middle of a sub-step, and its convection before the last pass.
  std::vector<double> half_way(double dt, const State& state, std::vector<double>& convection) const;
  /// Where the medium flows: the corrected mass times p, as `WaveOperator::add_convection` wants it. Collective.
  std::vector<double> momentum(const std::vector<double>& pressure, const LumpedTerms& terms, double dt) const;

  const mesh::Mesh* mesh_;
  const fem::Space* space_;
  const WaveOperator* wave_;
  double density_;
  std::vector<char> released_;  ///< (vertices) p = 0
};

}  // namespace vocalis::acoustic
