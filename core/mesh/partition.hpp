#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// A whole mesh, on rank 0; empty on the others.
struct WholeMesh {
  int dimension = 2;
  std::vector<double> coordinates;          ///< (vertices, dimension) [m]
  std::vector<std::int64_t> cell_vertices;  ///< (cells, dimension + 1)
  std::vector<std::int32_t> cell_region;
  std::vector<std::int64_t> facet_vertices;  ///< (named facets, dimension)
  std::vector<std::int32_t> facet_group;
  std::vector<std::int64_t> curved_edges;  ///< (curved edges, 2) vertices of the edges that are not straight
  std::vector<double> curved_points;       ///< (curved edges, dimension) [m] middle of each on the true curve
  std::vector<std::string> region_names, group_names;

  std::int64_t num_cells() const { return static_cast<std::int64_t>(cell_region.size()); }
};

/// Names that rank 0 has, on every rank. Collective.
std::vector<std::string> broadcast_names(MPI_Comm comm, const std::vector<std::string>& names);

/// A rank for each cell, by METIS, so that every kind of work is balanced by itself.
///
/// work   (cells, constraints): how much of each kind of work a cell is, in small whole numbers
std::vector<std::int32_t> partition_cells(const WholeMesh& mesh, int ranks, const std::vector<std::int32_t>& work,
                                          int constraints);

/// Sends each rank its cells. `cell_rank` counts on rank 0 only. Collective.
MeshPart scatter(MPI_Comm comm, const WholeMesh& mesh, const std::vector<std::int32_t>& cell_rank);

/// Partition with one unit of work a cell, scatter, build. Collective.
Mesh distribute(MPI_Comm comm, const WholeMesh& mesh);

}  // namespace vocalis::mesh
