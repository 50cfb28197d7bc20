#pragma once

#include <string>

#include "core/mesh/partition.hpp"

namespace vocalis::io {

/// The current model of Gmsh's library as a mesh: cells of the highest dimension that has any, the vertices that they
/// use, named regions and groups in the order of their tags; of second-order cells the corners and, if `curved`, the
/// middles of the edges that are not straight. One rank. Throws UserError for what is no proper mesh; `path` is for the
/// messages.
mesh::WholeMesh extract_model(const std::string& path, bool curved);

}  // namespace vocalis::io
