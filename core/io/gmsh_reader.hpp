#pragma once

#include <mpi.h>

#include <string>

#include "core/io/geo_parameters.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::io {

/// Meshes a Gmsh geometry on rank 0, with some of its DefineConstant parameters set.
///
/// The highest dimension with cells, 3 or 2, is that of the mesh; one of dimension 2 lies in the plane z = 0. Physical
/// groups of that dimension are the regions, those of one less the facet groups, by name in the order of their tags;
/// groups of one name are one. Lengths are in metres. Vertices that no cell has are left out, and cells are turned to
/// positive volume. Deterministic: the same geometry and parameters give the same mesh.
///
/// curved   whether to keep the middles of edges on curved boundaries, for isoparametric cells; the rest of the mesh is
///          the same without
/// returns  the whole mesh on rank 0, its dimension and names everywhere
/// Collective. Throws UserError on every rank: file missing, Gmsh's own errors with file and line, a parameter that the
/// geometry does not define, and whatever `read_mesh` rejects.
mesh::WholeMesh mesh_geometry(MPI_Comm comm, const std::string& path, const GeoValues& parameters, bool curved = false);

/// Reads any mesh file that Gmsh reads (and meshes one that has no cells yet). The same rules. A file knows no curves
/// but those of its second-order cells, whose middle nodes are left out unless `curved`.
/// Throws UserError: no cells; cells that are no triangles or tetrahedra of first or second order, that belong to no
/// region or several, that have no volume, or that their curved edges turn inside out; physical groups without a name;
/// coordinates that are not finite.
mesh::WholeMesh read_mesh(MPI_Comm comm, const std::string& path, bool curved = false);

}  // namespace vocalis::io
