#pragma once

#include <cstdint>
#include <span>

#include "core/mesh/mesh.hpp"

namespace vocalis::acoustic {

/// h [m] of a cell with the vertices' coordinates given: h² = 6 Σ |edge|² / (d (d + 1) (d + 2)), the length of a line's
/// cell whose lumped mass errs as much, for waves of all directions.
double cell_length(const mesh::Mesh& mesh, std::span<const double> coordinates, std::int32_t cell);

}  // namespace vocalis::acoustic
