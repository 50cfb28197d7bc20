#pragma once

#include <optional>
#include <vector>

#include "acoustic_solver/lumped_terms.hpp"
#include "acoustic_solver/state.hpp"
#include "acoustic_solver/still_rows.hpp"

namespace vocalis::acoustic {

/// The explicit scheme on a mesh that stands still. A sub-step is two sweeps over assembled rows, the first with the
/// stiffness and the second with the corrections of mass and time, each fused with what it updates; rows beside other
/// ranks come last, while their ghosts are on the way.
class StillLeapFrog {
 public:
  /// On the geometry that `wave` holds. Collective.
  StillLeapFrog(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave, double density);

  /// Largest eigenvalue of (lumped mass)⁻¹ stiffness / ρ [1/s²], by Lanczos.
  double largest_eigenvalue() const { return largest_eigenvalue_; }

  /// `parts` equal sub-steps of `step`. False, with the state as before, if the result is not finite. Collective.
  bool advance(const SubStep& step, int parts, State& state);

  /// What a sub-step reads and writes on this rank [bytes]: matrices and columns, and each vector once a sweep.
  double bytes_of_a_sub_step() const;

 private:
  /// A row with boundary terms.
  struct BoundaryRow {
    std::int32_t row;
    double admittance, potential, flux;
  };
  double lanczos() const;
  void set_step(double dt);
  void sweep_stiffness(std::int32_t first, std::int32_t last);
  void sweep_correction(std::int32_t first, std::int32_t last, double potential_factor);
  void sub_step(double flux, double potential_factor);

  const mesh::Mesh* mesh_;
  const fem::Space* space_;
  double density_;
  StillRows rows_;
  LumpedTerms terms_;
  std::vector<char> released_;  ///< (rows) p = 0
  std::vector<BoundaryRow> boundary_;
  double largest_eigenvalue_ = 0;
  double dt_ = 0;                         ///< [s] that the next two were made for
  std::vector<double> correction_;        ///< (entries) of N, docs/theory.md
  std::vector<double> inverse_diagonal_;  ///< (rows) 1 / (mass / dt + admittance / 2), 0 where p = 0
  std::vector<double> pressure_;          ///< (rows) p
  std::vector<double> potential_;         ///< (rows, ghosts) ψ half a sub-step from p
  std::vector<double> increment_;         ///< (rows, ghosts) change of p before the corrections
  std::vector<double> load_;              ///< (rows) or empty
};

}  // namespace vocalis::acoustic
