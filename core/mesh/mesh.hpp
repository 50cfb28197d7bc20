#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/halo.hpp"
#include "core/base/index_map.hpp"

namespace vocalis::mesh {

/// A facet that belongs to a named group, seen from one of its cells. A facet inside the mesh is listed once from
/// each side, on the rank of that side's cell.
struct NamedFacet {
  std::int32_t cell = 0;   ///< owned cell
  std::int32_t index = 0;  ///< which facet of it: the one opposite to this vertex of the cell
  std::int32_t group = 0;  ///< index in Mesh::group_names, or -1
};

/// A distributed mesh of triangles or tetrahedra; whole at construction (see `build_mesh`).
///
/// A cell belongs to one rank, which holds all of its vertices and edges; vertices and edges are shared. The cells
/// across the facets of this rank's cells are ghosts *by number only*: they have a region and no vertices.
struct Mesh {
  int dimension = 2;
  MPI_Comm comm = MPI_COMM_NULL;
  base::IndexMap vertices, edges, cells;
  base::Halo vertex_halo, edge_halo, cell_halo;

  std::vector<double> coordinates;            ///< (vertices.num_local, dimension) [m]; ghosts current
  std::vector<std::int32_t> cell_vertices;    ///< (cells.num_owned, dimension + 1), positive volume
  std::vector<std::int32_t> edge_vertices;    ///< (edges.num_local, 2)
  std::vector<double> edge_points;            ///< (edges.num_local, dimension) [m] middle of each edge on the true
                                              ///< curve, as built: it does not follow vertices that move; ghosts
                                              ///< current; empty where all edges are straight
  std::vector<std::int32_t> cell_edges;       ///< (cells.num_owned, 3 or 6), in the order of `edges_of_cell`
  std::vector<std::int32_t> cell_neighbours;  ///< (cells.num_owned, dimension + 1) across the facet opposite to each
                                              ///< vertex: a local cell (ghosts too), or -1
  std::vector<std::int32_t> cell_region;      ///< (cells.num_local) index in region_names; ghosts current
  std::vector<std::int64_t> vertex_input;     ///< (vertices.num_local) number in the mesh that was read
  std::vector<NamedFacet> named_facets;
  std::vector<std::string> region_names;
  std::vector<std::string> group_names;

  std::int32_t num_cells() const { return cells.num_owned; }
  std::int32_t num_vertices() const { return vertices.num_local(); }
  std::span<const std::int32_t> vertices_of(std::int32_t cell) const {
    return {cell_vertices.data() + static_cast<std::size_t>(cell) * (dimension + 1),
            static_cast<std::size_t>(dimension + 1)};
  }
  const double* point(std::int32_t vertex) const {
    return coordinates.data() + static_cast<std::size_t>(vertex) * dimension;
  }
};

/// The two local vertices of each edge of a cell: 3 edges of a triangle, 6 of a tetrahedron.
std::span<const std::array<int, 2>> edges_of_cell(int dimension);

/// A named region's or group's index, or -1.
int index_of(std::span<const std::string> names, const std::string& name);

/// What one rank needs to build its part of a mesh, wherever it comes from: its cells and their vertices.
struct MeshPart {
  int dimension = 2;
  std::vector<std::int64_t> vertex_input;   ///< number of each vertex in the whole mesh
  std::vector<double> coordinates;          ///< (vertices, dimension) [m]
  std::vector<std::int32_t> cell_vertices;  ///< (cells, dimension + 1) indices into vertex_input
  std::vector<std::int32_t> cell_region;
  std::vector<std::int32_t> facet_vertices;  ///< (named facets, dimension) indices into vertex_input
  std::vector<std::int32_t> facet_group;
  std::vector<std::int32_t> curved_edges;  ///< (curved edges, 2) indices into vertex_input; in every part with both
  std::vector<double> curved_points;       ///< (curved edges, dimension) [m] their middles; other edges are straight
  std::vector<std::string> region_names, group_names;
};

/// Finds shared vertices and edges, gives each one owner (the lowest rank with a cell there), and the neighbours
/// across facets. A named facet or a curved edge that no cell of the part has is dropped. Collective.
Mesh build_mesh(MPI_Comm comm, const MeshPart& part);

}  // namespace vocalis::mesh
