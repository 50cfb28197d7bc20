#pragma once

#include <vector>

#include "acoustic_solver/wave_operator.hpp"

namespace vocalis::acoustic {

/// Diagonals that an explicit step needs, one number a local vertex, ghosts current: row sums of the integrals of
/// `WaveOperator`.
struct LumpedTerms {
  std::vector<double> mass;             ///< (1 / (ρ c²)) (1, q)
  std::vector<double> stiffness;        ///< (∇q, ∇q), the diagonal of the stiffness, boundary terms apart
  std::vector<double> admittance;       ///< <µ / (ρ c), q>
  std::vector<double> open_admittance;  ///< of it, what open boundaries have
  std::vector<double> potential;        ///< <1 / R, q>_open
  std::vector<double> flux;             ///< <1, q> over the facets where the source enters
};

/// On the geometry that `wave` holds. Collective.
LumpedTerms lumped_terms(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave);

/// A bound from above of the largest eigenvalue of mass⁻¹ (stiffness + potential) / ρ [1/s²]: never below it, and up to
/// twice as large on tetrahedra of poor shape. Each vertex' mass is shared among its cells in proportion to their parts
/// of its stiffness; then the largest eigenvalue of any cell bounds that of the mesh (Irons & Treharne 1971; Fried
/// 1972, with the sharing that is sharpest for cells of unequal shapes). Infinite where a cell has no volume.
/// Collective.
double eigenvalue_bound(const mesh::Mesh& mesh, const WaveOperator& wave, const LumpedTerms& terms, double density);

}  // namespace vocalis::acoustic
