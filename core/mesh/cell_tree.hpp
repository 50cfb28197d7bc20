#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/mesh/closest_point.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::mesh {

/// A box along the axes; empty until something is added.
struct Box {
  std::array<double, 3> low = {infinity, infinity, infinity};      ///< [m]
  std::array<double, 3> high = {-infinity, -infinity, -infinity};  ///< [m]

  static constexpr double infinity = std::numeric_limits<double>::infinity();
  void add(const std::array<double, 3>& point);
  /// Of a point [m]: 0 inside, infinite from an empty box.
  double distance(const std::array<double, 3>& point) const;
};

/// The nearest of this rank's cells to a point.
struct NearestCell {
  std::int32_t cell = -1;  ///< -1: none within reach
  ClosestPoint closest;
};

/// This rank's cells by the boxes around them, halved again and again at the median of the longest side, so that the
/// cell at a point is found in a time that grows with the logarithm of their number. At the mesh's coordinates when the
/// tree was made; refers to the mesh.
class CellTree {
 public:
  /// cell_counts  (owned cells) not 0 where a cell is to be found; empty: all are
  explicit CellTree(const Mesh& mesh, std::span<const std::int32_t> cell_counts = {});

  /// A cell that contains the point, or else the nearest one whose distance is at most `reach` [m].
  NearestCell nearest(const std::array<double, 3>& point, double reach) const;

  /// Around all cells of this rank.
  Box box() const { return nodes_.empty() ? Box{} : nodes_.front().box; }

 private:
  struct Node {
    Box box;
    std::int32_t first = 0, count = 0;  ///< its cells in `cells_`
    std::int32_t children = -1;         ///< two of them from here in `nodes_`; -1: none
  };

  void split(std::int32_t node);
  Box box_around(std::int32_t first, std::int32_t count) const;
  void search(std::int32_t node, const std::array<double, 3>& point, NearestCell& best) const;

  const Mesh* mesh_;
  std::vector<Box> cell_boxes_;
  std::vector<std::int32_t> cells_;
  std::vector<Node> nodes_;
};

}  // namespace vocalis::mesh
