#include "core/mesh/cell_tree.hpp"

#include <algorithm>
#include <cmath>

namespace vocalis::mesh {

void Box::add(const std::array<double, 3>& point) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], point[k]);
    high[k] = std::max(high[k], point[k]);
  }
}

double Box::distance(const std::array<double, 3>& point) const {
  double square = 0;
  for (int k = 0; k < 3; ++k) square += std::pow(std::max({low[k] - point[k], point[k] - high[k], 0.0}), 2);
  return std::sqrt(square);
}

CellTree::CellTree(const Mesh& mesh, std::span<const std::int32_t> cell_counts)
    : mesh_(&mesh), cell_boxes_(mesh.num_cells()) {
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!cell_counts.empty() && !cell_counts[cell]) continue;
    cells_.push_back(cell);
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      std::array<double, 3> point = {0, 0, 0};
      std::copy_n(mesh.point(vertex), mesh.dimension, point.begin());
      cell_boxes_[cell].add(point);
    }
  }
  if (cells_.empty()) return;
  const auto count = static_cast<std::int32_t>(cells_.size());
  nodes_.push_back({box_around(0, count), 0, count, -1});
  split(0);
}

Box CellTree::box_around(std::int32_t first, std::int32_t count) const {
  Box box;
  for (std::int32_t i = first; i < first + count; ++i) {
    box.add(cell_boxes_[cells_[i]].low);
    box.add(cell_boxes_[cells_[i]].high);
  }
  return box;
}

void CellTree::split(std::int32_t node) {
  constexpr std::int32_t few = 8;
  const Node parent = nodes_[node];
  if (parent.count <= few) return;
  int longest = 0;
  const auto side = [&](int k) { return parent.box.high[k] - parent.box.low[k]; };
  for (int k = 1; k < 3; ++k) longest = side(k) > side(longest) ? k : longest;
  const auto twice_middle = [&](std::int32_t cell) {
    return cell_boxes_[cell].low[longest] + cell_boxes_[cell].high[longest];
  };
  const auto first = cells_.begin() + parent.first;
  const std::int32_t half = parent.count / 2;
  std::nth_element(first, first + half, first + parent.count,
                   [&](auto a, auto b) { return twice_middle(a) < twice_middle(b); });
  const auto children = static_cast<std::int32_t>(nodes_.size());
  nodes_[node].children = children;
  nodes_.push_back({box_around(parent.first, half), parent.first, half, -1});
  nodes_.push_back(
      {box_around(parent.first + half, parent.count - half), parent.first + half, parent.count - half, -1});
  split(children);
  split(children + 1);
}

NearestCell CellTree::nearest(const std::array<double, 3>& point, double reach) const {
  NearestCell best;
  best.closest.distance = reach;
  if (!nodes_.empty()) search(0, point, best);
  return best;
}

void CellTree::search(std::int32_t node, const std::array<double, 3>& point, NearestCell& best) const {
  const auto is_hopeless = [&](const Box& box) {
    const double distance = box.distance(point);
    return best.cell < 0 ? distance > best.closest.distance : distance >= best.closest.distance;
  };
  if (is_hopeless(nodes_[node].box)) return;
  if (const std::int32_t children = nodes_[node].children; children >= 0) {
    const bool second_is_nearer = nodes_[children + 1].box.distance(point) < nodes_[children].box.distance(point);
    search(children + (second_is_nearer ? 1 : 0), point, best);
    search(children + (second_is_nearer ? 0 : 1), point, best);
    return;
  }
  for (std::int32_t i = nodes_[node].first; i < nodes_[node].first + nodes_[node].count; ++i) {
    if (is_hopeless(cell_boxes_[cells_[i]])) continue;
    const ClosestPoint there = closest_point(*mesh_, cells_[i], point);
    const bool is_better =
        best.cell < 0 ? there.distance <= best.closest.distance : there.distance < best.closest.distance;
    if (is_better) best = {cells_[i], there};
  }
}

}  // namespace vocalis::mesh
