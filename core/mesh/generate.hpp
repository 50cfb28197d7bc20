#pragma once

#include <array>

#include "core/mesh/partition.hpp"

namespace vocalis::mesh {

/// A box [0, size] cut into cells[0] x cells[1] (x cells[2]) bricks, each of 2 triangles or 6 tetrahedra, one region
/// "box", facet groups "left", "right" (x), "bottom", "top" (y), "front", "back" (z). Whole on rank 0. For tests.
///
/// size   edge lengths [m]; size[2] = 0 makes it two-dimensional
WholeMesh box(MPI_Comm comm, std::array<double, 3> size, std::array<int, 3> cells);

}  // namespace vocalis::mesh
