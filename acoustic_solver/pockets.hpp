#pragma once

#include <cstdint>
#include <vector>

#include "acoustic_solver/wave_operator.hpp"
#include "core/fem/space.hpp"

namespace vocalis::acoustic {

/// The pockets of a mesh: its parts with no vertex in common, so that no sound goes from one to another. For each local
/// vertex the smallest input number of its pocket's vertices. Collective.
std::vector<std::int32_t> find_pockets(const mesh::Mesh& mesh);

/// Where the vertices of a mesh stripped anew were before; ghosts current.
struct PocketsBefore {
  std::vector<std::int32_t> name;      ///< (vertices) of `find_pockets` of the mesh before, or -1: new
  std::vector<std::int32_t> is_bound;  ///< (vertices) not 0: ψ itself acts there, not its gradient alone
};

/// Where pockets are joined by air that has opened, a constant is added to ψ of each but one, such that
///
///   ∫ ½ ρ |∇ψ|² over the opened air is least:
///
/// the air between them begins as nearly at rest as a potential lets it. A constant is no velocity, but while pockets
/// are apart their potentials drift apart by ∫ Δp / ρ dt, which would be one in the gap. The pocket that keeps its
/// potential is the one where ψ itself acts (open spheres, absorbing layers), or else the largest; where several such
/// meet they all keep theirs. Collective.
///
/// wave  of the mesh, with its geometry; `space` is P1 on it
/// psi   (vertices) with new ones filled (`transfer::fill`), ghosts current; so they are on exit
void join_pockets(const PocketsBefore& before, const WaveOperator& wave, const fem::Space& space,
                  std::vector<double>& psi);

}  // namespace vocalis::acoustic
