#include "core/io/gmsh_reader.hpp"

#include <vector>

#include "core/base/first_rank.hpp"
#include "core/base/mpi.hpp"
#include "core/io/gmsh_model.hpp"
#include "core/io/gmsh_session.hpp"

namespace vocalis::io {

mesh::WholeMesh mesh_geometry(MPI_Comm comm, const std::string& path, const GeoValues& parameters, bool curved) {
  mesh::WholeMesh mesh;
  base::on_first_rank(comm, [&] {
    const GmshSession session(path, parameters, curved);
    mesh = extract_model(path, curved);
  });
  std::vector<std::int32_t> dimension = {mesh.dimension};
  base::broadcast(comm, dimension);
  mesh.dimension = dimension[0];
  mesh.region_names = mesh::broadcast_names(comm, mesh.region_names);
  mesh.group_names = mesh::broadcast_names(comm, mesh.group_names);
  return mesh;
}

mesh::WholeMesh read_mesh(MPI_Comm comm, const std::string& path, bool curved) {
  return mesh_geometry(comm, path, {}, curved);
}

}  // namespace vocalis::io
