#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::io {

/// The vertices and cells of a mesh in an order that does not depend on how ranks share them: vertices by their number
/// in the mesh that was read, cells by their vertices' numbers. Rank 0 holds what all have together.
class InputOrder {
 public:
  /// The mesh must outlive it. Collective.
  explicit InputOrder(const mesh::Mesh& mesh);

  /// Values of all vertices on rank 0, (vertices.num_global, components); nothing on the others. Ghosts are not read.
  /// Collective.
  std::vector<double> gather(std::span<const double> values, int components) const;
  /// The way back; ghosts are current. Collective.
  std::vector<double> scatter(const std::vector<double>& all, int components) const;

  /// The same for marks of cells, (cells.num_owned) here and (cells.num_global) on rank 0. Collective.
  std::vector<char> gather_marks(std::span<const char> marks) const;
  std::vector<char> scatter_marks(const std::vector<char>& all) const;

  /// (cells.num_global, dimension + 1) places of each cell's vertices in this order, rising; rank 0.
  const std::vector<std::int64_t>& cells() const { return cells_; }

 private:
  const mesh::Mesh& mesh_;
  std::vector<std::int64_t> vertex_place_;  ///< of the n-th vertex in the order of ranks; rank 0, as all below
  std::vector<std::int64_t> cell_place_;
  std::vector<std::int64_t> vertex_counts_, cell_counts_;  ///< of each rank
  std::vector<std::int64_t> cells_;
};

}  // namespace vocalis::io
