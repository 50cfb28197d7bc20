#pragma once

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// Finds the cell across each facet, on this rank or another, and fills cell_neighbours, the ghost part of `cells`,
/// cell_halo and the ghosts of cell_region. Needs vertices, edges and the owned cells. Collective.
void connect_neighbours(Mesh& mesh);

}  // namespace vocalis::mesh
