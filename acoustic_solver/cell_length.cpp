#include "acoustic_solver/cell_length.hpp"

#include <cmath>

namespace vocalis::acoustic {

double cell_length(const mesh::Mesh& mesh, std::span<const double> coordinates, std::int32_t cell) {
  const int d = mesh.dimension;
  const auto vertices = mesh.vertices_of(cell);
  double sum = 0;
  for (int i = 0; i <= d; ++i) {
    for (int j = 0; j < i; ++j) {
      for (int k = 0; k < d; ++k) {
        const double edge = coordinates[static_cast<std::size_t>(vertices[i]) * d + k] -
                            coordinates[static_cast<std::size_t>(vertices[j]) * d + k];
        sum += edge * edge;
      }
    }
  }
  return std::sqrt(6 * sum / (d * (d + 1) * (d + 2)));
}

}  // namespace vocalis::acoustic
