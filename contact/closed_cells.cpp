#include "contact/closed_cells.hpp"

#include "core/base/mpi.hpp"

namespace vocalis::contact {

ClosedCells::Nearest ClosedCells::nearest(const std::array<double, 3>& place) const {
  Nearest result;
  for (std::size_t i = 0; i < count(); ++i) {
    double square = 0;
    for (int k = 0; k < dimension; ++k) {
      const double way = middles[i * dimension + k] - place[k];
      square += way * way;
    }
    if (square < result.square) result = {i, square};
  }
  return result;
}

ClosedCells gather_closed(const mesh::Mesh& mesh, std::span<const double> coordinates,
                          std::span<const double> closing_gap, std::span<const double> normal) {
  const int d = mesh.dimension;
  ClosedCells mine{d, {}, {}};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (closing_gap[cell] == 0) continue;
    const auto place = middle(mesh, cell, coordinates);
    mine.middles.insert(mine.middles.end(), place.begin(), place.begin() + d);
    const auto first = normal.begin() + static_cast<std::ptrdiff_t>(cell) * d;
    mine.normals.insert(mine.normals.end(), first, first + d);
  }
  return {d, base::concatenate_all(mesh.comm, mine.middles), base::concatenate_all(mesh.comm, mine.normals)};
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
