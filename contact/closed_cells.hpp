#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::contact {

/// The closed cells of the medial axis, of all ranks and the same on each.
struct ClosedCells {
  int dimension = 2;
  std::vector<double> middles = {};  ///< (closed cells, dimension) [m]
  std::vector<double> normals = {};  ///< (closed cells, dimension) across the gap at closing

  int axis = 0;                         ///< along which they lie farthest apart ...
  std::vector<std::size_t> order = {};  ///< ... and their order along it

  std::size_t count() const { return normals.size() / dimension; }

  struct Nearest {
    std::size_t index = 0;
    double square = std::numeric_limits<double>::infinity();  ///< of the distance [m^2]; infinite if none is closed
  };
  /// The first of the nearest ones.
  Nearest nearest(const std::array<double, 3>& place) const;
};

/// coordinates  (vertices, dimension) [m]
/// closing_gap  (owned cells) not 0 in closed ones
/// normal       (owned cells, dimension)
/// Collective.
ClosedCells gather_closed(const mesh::Mesh& mesh, std::span<const double> coordinates,
                          std::span<const double> closing_gap, std::span<const double> normal);

/// Mean of a cell's corners [m]; 0 beyond the dimension.
std::array<double, 3> middle(const mesh::Mesh& mesh, std::int32_t cell, std::span<const double> coordinates);

}  // namespace vocalis::contact
