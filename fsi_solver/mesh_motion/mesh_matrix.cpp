#include "fsi_solver/mesh_motion/mesh_matrix.hpp"

namespace vocalis::fsi {

std::vector<char> constrained_places(const Continuum& continuum, const Conditions& conditions) {
  const mesh::Mesh& mesh = *continuum.mesh;
  std::vector<char> result(static_cast<std::size_t>(mesh.vertices.num_owned) * mesh.dimension, 0);
  for (std::size_t i = 0; i < result.size(); ++i) {
    result[i] = continuum.vertex_solid[i / mesh.dimension] >= 0 || conditions.mesh_is_held[i];
  }
  return result;
}

std::unique_ptr<la::AssembledMatrix> make_mesh_matrix(const Continuum& continuum, const la::SystemLayout& layout,
                                                      const std::vector<char>& constrained) {
  const mesh::Mesh& mesh = *continuum.mesh;
  const int d = mesh.dimension;
  std::vector<PetscInt> fixed_rows;
  for (std::size_t i = 0; i < constrained.size(); ++i) {
    if (constrained[i]) fixed_rows.push_back(static_cast<PetscInt>(i));
  }
  std::vector<PetscInt> rows;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      for (int k = 0; k < d; ++k) rows.push_back(continuum.cell_solid[cell] < 0 ? layout.global(0, vertex, k) : -1);
    }
  }
  return std::make_unique<la::AssembledMatrix>(layout, rows, d * (d + 1), fixed_rows);
}

}  // namespace vocalis::fsi
