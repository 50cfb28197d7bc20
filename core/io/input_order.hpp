#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/mesh/mesh.hpp"

namespace vocalis::io {

/// Where values lie.
enum class Place { vertices, edges };

/// The vertices, edges and cells of a mesh in an order that does not depend on how ranks share them: vertices by their
/// number in the mesh that was read, the others by their vertices' numbers. Rank 0 holds what all have together.
class InputOrder {
 public:
  /// The mesh must outlive it. Collective.
  explicit InputOrder(const mesh::Mesh& mesh);

  /// Values of all vertices (edges) on rank 0, (vertices.num_global, components); nothing on the others. Ghosts are not
  /// read. Collective.
  std::vector<double> gather(std::span<const double> values, int components, Place where = Place::vertices) const;
  /// The way back; ghosts are current. Collective.
  std::vector<double> scatter(const std::vector<double>& all, int components, Place where = Place::vertices) const;

  /// The same for marks of cells, (cells.num_owned) here and (cells.num_global) on rank 0. Collective.
  std::vector<char> gather_marks(std::span<const char> marks) const;
  std::vector<char> scatter_marks(const std::vector<char>& all) const;

  /// (cells.num_global, dimension + 1) and (edges.num_global, 2): places of their vertices in this order, rising; rank
  /// 0.
  const std::vector<std::int64_t>& cells() const { return cells_.vertices; }
  const std::vector<std::int64_t>& edges() const { return edges_.vertices; }

 private:
  struct Entities {
    std::vector<std::int64_t> counts;    ///< that each rank owns
    std::vector<std::int64_t> place;     ///< of the n-th in the order of ranks; rank 0, as the next
    std::vector<std::int64_t> vertices;  ///< places of each one's vertices
  };
  Entities sorted(const base::IndexMap& map, std::span<const std::int32_t> vertices, int corners) const;
  const Entities& at(Place where) const { return where == Place::edges ? edges_ : vertices_; }

  const mesh::Mesh& mesh_;
  Entities vertices_, edges_, cells_;
};

}  // namespace vocalis::io
