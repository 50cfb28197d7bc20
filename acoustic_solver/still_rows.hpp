#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "acoustic_solver/wave_operator.hpp"

namespace vocalis::acoustic {

/// Stiffness and mass of a mesh that stands still, assembled for sweeps: whole rows of the owned vertices, in an order
/// in which neighbours are close to each other. Both operators K and M_L - M (lumped minus consistent mass) vanish on
/// constants, so that their entries beside the diagonal say all: (K x)_i = Σ_j k_ij (x_j - x_i).
///
/// Vectors have one number a row, then one a ghost: the vertices beside the owned rows, more than the mesh's ghosts.
struct StillRows {
  std::vector<std::int32_t> vertex;   ///< owned vertex of each row
  std::int32_t num_inner = 0;         ///< rows without ghosts among their columns; they come first
  std::vector<std::int32_t> starts;   ///< (rows + 1)
  std::vector<std::int32_t> columns;  ///< (entries) rows or ghosts
  std::vector<double> stiffness;      ///< (entries) k_ij, i ≠ j
  std::vector<double> mass;           ///< (entries) m_ij, i ≠ j, of (1 / (ρ c²)) (p, q)
  base::IndexMap map;                 ///< rows, in their order, and ghosts
  base::Halo halo;

  std::int32_t num_rows() const { return static_cast<std::int32_t>(vertex.size()); }
};

/// On the geometry that `wave` holds, without boundary terms. Collective.
StillRows assemble_still_rows(const mesh::Mesh& mesh, const WaveOperator& wave);

}  // namespace vocalis::acoustic
