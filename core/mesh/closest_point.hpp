#pragma once

#include <array>
#include <cstdint>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// The point of a cell that is nearest to a given one.
struct ClosestPoint {
  std::array<double, 4> barycentric = {0, 0, 0, 0};  ///< the first dimension + 1 count; their sum is 1
  double distance = 0;                               ///< [m] 0 where the given point is inside
};

/// A point that is outside by rounding alone is inside, at its own barycentric coordinates. One further out is
/// projected onto the nearest facet, edge or vertex; its barycentric coordinates are in [0, 1].
ClosestPoint closest_point(const Mesh& mesh, std::int32_t cell, const std::array<double, 3>& point);

}  // namespace vocalis::mesh
