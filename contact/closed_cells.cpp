#include "contact/closed_cells.hpp"

#include <algorithm>
#include <numeric>

#include "core/base/mpi.hpp"

namespace vocalis::contact {

namespace {

void sort(ClosedCells& cells) {
  double widest = -1;
  for (int k = 0; k < cells.dimension; ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < cells.count(); ++i) {
      low = std::min(low, cells.middles[i * cells.dimension + k]);
      high = std::max(high, cells.middles[i * cells.dimension + k]);
    }
    if (high - low > widest) {
      widest = high - low;
      cells.axis = k;
    }
  }
  cells.order.resize(cells.count());
  std::iota(cells.order.begin(), cells.order.end(), std::size_t{0});
  std::sort(cells.order.begin(), cells.order.end(), [&](std::size_t a, std::size_t b) {
    return cells.middles[a * cells.dimension + cells.axis] < cells.middles[b * cells.dimension + cells.axis];
  });
}

}  // namespace

ClosedCells::Nearest ClosedCells::nearest(const std::array<double, 3>& place) const {
  Nearest result;
  // Whether cells further on in this direction may be as near.
  const auto visit = [&](std::size_t i) {
    double square = 0;
    for (int k = 0; k < dimension; ++k) {
      const double way = middles[i * dimension + k] - place[k];
      square += way * way;
    }
    if (square < result.square || (square == result.square && i < result.index)) result = {i, square};
    const double ahead = middles[i * dimension + axis] - place[axis];
    return ahead * ahead <= result.square;
  };
  const auto middle = std::partition_point(order.begin(), order.end(),
                                           [&](std::size_t i) { return middles[i * dimension + axis] < place[axis]; });
  for (auto i = middle; i != order.end() && visit(*i);) ++i;
  for (auto i = middle; i != order.begin() && visit(*(i - 1));) --i;
  return result;
}

ClosedCells gather_closed(const mesh::Mesh& mesh, std::span<const double> coordinates,
                          std::span<const double> closing_gap, std::span<const double> normal) {
  const int d = mesh.dimension;
  ClosedCells mine{.dimension = d};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (closing_gap[cell] == 0) continue;
    const auto place = middle(mesh, cell, coordinates);
    mine.middles.insert(mine.middles.end(), place.begin(), place.begin() + d);
    const auto first = normal.begin() + static_cast<std::ptrdiff_t>(cell) * d;
    mine.normals.insert(mine.normals.end(), first, first + d);
  }
  ClosedCells all{.dimension = d,
                  .middles = base::concatenate_all(mesh.comm, mine.middles),
                  .normals = base::concatenate_all(mesh.comm, mine.normals)};
  sort(all);
  return all;
}

std::array<double, 3> middle(const mesh::Mesh& mesh, std::int32_t cell, std::span<const double> coordinates) {
  std::array<double, 3> result = {0, 0, 0};
  for (const std::int32_t v : mesh.vertices_of(cell)) {
    for (int k = 0; k < mesh.dimension; ++k) {
      result[k] += coordinates[static_cast<std::size_t>(v) * mesh.dimension + k] / (mesh.dimension + 1);
    }
  }
  return result;
}

}  // namespace vocalis::contact
