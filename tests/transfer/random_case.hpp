#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "core/mesh/partition.hpp"

namespace vocalis::transfer {

/// A small mesh with a rank for each cell, the same on every rank of a communicator: what brute force looks at.
struct RandomCase {
  mesh::WholeMesh whole;
  std::vector<std::int32_t> cell_rank;
  std::vector<std::vector<std::int64_t>> cells_of_rank;  ///< whole cells, in the order in which a rank gets them

  mesh::Mesh distribute(MPI_Comm comm) const;
};

using Random = std::mt19937_64;

/// A whole number from 0 to `below` - 1.
std::int64_t draw(Random& random, std::int64_t below);

/// Triangles or tetrahedra in random order, three regions, sides and some inner facets named, some edges curved; cells
/// dealt to ranks at random, in blocks, or all to one rank.
RandomCase random_case(Random& random, int ranks);

/// A mask over the whole cells: each cell by chance, a single cell, half of the box, nothing, all, or some ranks empty.
std::vector<std::int32_t> random_mask(Random& random, const RandomCase& on);

/// The part of a mask that a rank needs, for its own cells.
std::vector<std::int32_t> mask_of_rank(const RandomCase& on, const std::vector<std::int32_t>& mask, int rank);

}  // namespace vocalis::transfer
