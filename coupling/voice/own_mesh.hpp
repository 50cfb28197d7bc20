#pragma once

#include "core/mesh/mesh.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

/// Reads or makes the own mesh of an [[acoustic]], given by its name, and distributes it with a partition of its own.
/// It is air throughout, but for regions that the case names as solids, which are left out. Throws UserError for what
/// the mesh does not have, and if its dimension is another than the case's. Collective.
mesh::Mesh make_own_mesh(MPI_Comm comm, const Case& config, const std::string& name, int dimension);

}  // namespace vocalis::coupling
