#pragma once

#include <array>
#include <cstdint>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// A point inside a cell. The rank that holds the cell is the same number on every rank, -1 if no cell contains it.
struct Location {
  int rank = -1;
  std::int32_t cell = -1;                            ///< on that rank
  std::array<double, 4> barycentric = {0, 0, 0, 0};  ///< on that rank; the first dimension + 1 count
};

/// Barycentric coordinates of a point in a cell; all in [0, 1] when it is inside.
std::array<double, 4> barycentric_coordinates(const Mesh& mesh, std::int32_t cell, const std::array<double, 3>& point);

/// The cell that contains a point [m]: of several, the one where it lies deepest, then the lowest rank. Collective.
Location locate(const Mesh& mesh, const std::array<double, 3>& point);

}  // namespace vocalis::mesh
