#include "coupling/voice/own_mesh.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/io/gmsh_reader.hpp"
#include "core/mesh/partition.hpp"

namespace vocalis::coupling {

namespace {

void leave_out_solids(const Case& config, mesh::WholeMesh& whole) {
  const std::size_t corners = whole.dimension + 1;
  std::vector<bool> is_solid(whole.region_names.size(), false);
  for (const Region& region : config.regions) {
    const int index = mesh::index_of(whole.region_names, region.name);
    if (index >= 0) is_solid[index] = region.kind == RegionKind::solid;
  }
  std::size_t kept = 0;
  for (std::size_t cell = 0; cell < whole.cell_region.size(); ++cell) {
    if (is_solid[whole.cell_region[cell]]) continue;
    std::copy_n(whole.cell_vertices.begin() + static_cast<std::ptrdiff_t>(cell * corners), corners,
                whole.cell_vertices.begin() + static_cast<std::ptrdiff_t>(kept * corners));
    whole.cell_region[kept++] = whole.cell_region[cell];
  }
  whole.cell_region.resize(kept);
  whole.cell_vertices.resize(kept * corners);
}

}  // namespace

mesh::Mesh make_own_mesh(MPI_Comm comm, const Case& config, const std::string& name, int dimension) {
  const MeshSettings& source = config.acoustic_meshes.at(name).mesh;
  mesh::WholeMesh whole =
      source.is_geometry ? io::mesh_geometry(comm, source.file, source.parameters) : io::read_mesh(comm, source.file);
  if (whole.dimension != dimension) {
    throw base::UserError("the mesh of [[acoustic]] \"" + name + "\" must have the dimension of the case's",
                          std::to_string(whole.dimension) + " in " + source.file,
                          "take one of dimension " + std::to_string(dimension));
  }
  check_acoustic_against_mesh_names(config, name, whole.group_names);
  leave_out_solids(config, whole);
  if (base::sum(comm, whole.num_cells()) == 0) {
    throw base::UserError("the mesh of [[acoustic]] \"" + name + "\" needs a region of air",
                          "solids only in " + source.file, "name a region of it that is no solid of the case");
  }
  return mesh::distribute(comm, whole);
}

}  // namespace vocalis::coupling
