#pragma once

#include <memory>
#include <vector>

#include "core/mesh/mesh.hpp"
#include "coupling/case/case.hpp"
#include "transfer/strip.hpp"

namespace vocalis::coupling {

/// The meshes of one case: the parent with all its regions, and what each solver keeps of it. Built whole, kept at one
/// place (spaces point into it).
struct Scene {
  mesh::Mesh parent;
  std::vector<RegionKind> kind_of_region;            ///< by index in parent.region_names
  std::unique_ptr<transfer::StrippedMesh> flow;      ///< the parent without air; none without [flow]
  std::unique_ptr<transfer::StrippedMesh> acoustic;  ///< the parent without solids; none where a flow is and
                                                     ///< no [[acoustic]] sounds on it
};

/// Reads or makes the mesh, distributes it and strips it. Cells are shared out so that the flow's work and the
/// acoustics' work are balanced each by itself. A flow with P2 velocities gets curved edges. Throws UserError for what
/// the mesh does not have. Collective.
std::unique_ptr<Scene> build_scene(MPI_Comm comm, const Case& config);

/// Where the flow ends inside the air: facets of the flow mesh whose neighbour in the parent is air.
std::vector<mesh::NamedFacet> flow_outlet(const Scene& scene);

/// Where the fluid ends at a solid or at the rim of the mesh: walls, and boundaries that it flows through.
std::vector<mesh::NamedFacet> flow_walls(const Scene& scene);

/// Whether each owned cell of the flow mesh is fluid.
std::vector<std::int32_t> fluid_cells(const Scene& scene);

}  // namespace vocalis::coupling
