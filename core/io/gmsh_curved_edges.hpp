#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/partition.hpp"

namespace vocalis::io {

/// An edge of a second-order element: its two vertices in the mesh, and Gmsh's tag of the node in its middle.
struct EdgeMiddle {
  std::int64_t first = 0, second = 0;
  std::size_t node = 0;
};

/// Gives the mesh the edges whose middle is farther than 1e-10 of their length from that of the straight edge, each
/// once, by the numbers of their vertices. Asks Gmsh's current model for the nodes. One rank.
///
/// Throws UserError: a middle that is not finite; a cell that its curved edges turn inside out, so that the Jacobian
/// determinant of its P2 map is not positive at one of its corners or middles.
void add_curved_edges(const std::string& path, std::vector<EdgeMiddle> middles, mesh::WholeMesh& mesh);

}  // namespace vocalis::io
