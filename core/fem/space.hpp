#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::fem {

/// A Lagrange space of degree 1 (vertices) or 2 (vertices and edges) on the labelled cells of a mesh. Functions are
/// continuous among cells of one label and may jump between labels; cells of label -1 have no unknowns.
struct Space {
  const mesh::Mesh* mesh = nullptr;  ///< must outlive the space
  int degree = 1;
  int dofs_per_cell = 0;  ///< P1: d + 1; P2: 6 or 10, vertices first, then edges
  base::IndexMap dofs;
  base::Halo halo;
  std::vector<std::int32_t> cell_dofs;   ///< (cells, dofs_per_cell); -1 in cells without unknowns
  std::vector<std::int32_t> dof_vertex;  ///< vertex of each local dof, or -1 (an edge's)
  std::vector<std::int32_t> dof_edge;    ///< edge of each local dof, or -1 (a vertex's)
  std::vector<std::int32_t> dof_label;   ///< label of each local dof

  std::int32_t num_dofs() const { return dofs.num_local(); }
  std::span<const std::int32_t> dofs_of(std::int32_t cell) const {
    return {cell_dofs.data() + static_cast<std::size_t>(cell) * dofs_per_cell, static_cast<std::size_t>(dofs_per_cell)};
  }
};

/// One label everywhere. For degree 1 the dofs are the vertices, in the same numbering. Collective.
Space lagrange(const mesh::Mesh& mesh, int degree);

/// cell_label  (owned cells) label >= 0, or -1 where the space does not exist. Collective.
Space lagrange(const mesh::Mesh& mesh, int degree, std::span<const std::int32_t> cell_label);

/// Where each local dof is [m], (dofs, dimension): a vertex, or the middle of an edge, on its curve where the mesh has
/// curved edges. On straight cells they are where the P2 basis is 1; on curved ones they make the isoparametric map.
std::vector<double> dof_points(const Space& space);

}  // namespace vocalis::fem
