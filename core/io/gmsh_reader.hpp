#pragma once

#include <mpi.h>

#include <map>
#include <string>

#include "core/mesh/partition.hpp"

namespace vocalis::io {

/// Meshes a Gmsh geometry, with some of its DefineConstant parameters set. Highest dimension with cells (2 or 3) is the
/// mesh's; physical groups of cells are its regions, those of facets its groups. Deterministic: the same geometry and
/// parameters give the same mesh.
///
/// returns  the whole mesh on rank 0, its dimension and names everywhere
/// Collective. Throws UserError on every rank: file missing, Gmsh's own errors with file and line, a parameter that the
/// geometry does not define, and whatever `read_mesh` rejects.
mesh::WholeMesh mesh_geometry(MPI_Comm comm, const std::string& path, const std::map<std::string, double>& parameters);

/// Reads any mesh file that Gmsh reads. The same rules.
/// Throws UserError: no cells, cells that are not simplices, cells without a named region, cells without volume,
/// coordinates that are not finite.
mesh::WholeMesh read_mesh(MPI_Comm comm, const std::string& path);

}  // namespace vocalis::io
