#include "coupling/monitors/line_flux.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::coupling {

namespace {

constexpr double rounding = 1e-9;  // of barycentric coordinates

/// The part of a line inside a straight triangle: from begin to end of [0, 1], empty if begin >= end.
struct Part {
  double begin = 0, end = 1;
  int along = -1;  ///< the facet that it runs along, if it does
};

fem::Point between(const fem::Point& from, const fem::Point& to, double s) {
  return {from[0] + s * (to[0] - from[0]), from[1] + s * (to[1] - from[1]), 0};
}

/// Barycentric coordinates as if the cell were straight.
fem::Barycentric straight_coordinates(const std::array<fem::Point, 3>& corners, const fem::Point& point) {
  const auto doubled_area = [](const fem::Point& a, const fem::Point& b, const fem::Point& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  };
  const double whole = doubled_area(corners[0], corners[1], corners[2]);
  return {doubled_area(point, corners[1], corners[2]) / whole, doubled_area(corners[0], point, corners[2]) / whole,
          doubled_area(corners[0], corners[1], point) / whole, 0};
}

Part part_inside(const std::array<fem::Point, 3>& corners, const fem::Point& from, const fem::Point& to) {
  const fem::Barycentric first = straight_coordinates(corners, from), last = straight_coordinates(corners, to);
  Part part;
  for (int i = 0; i < 3; ++i) {
    if (std::abs(first[i]) < rounding && std::abs(last[i]) < rounding) {
      part.along = i;
      continue;
    }
    // Where first + s (last - first) >= 0
    if (first[i] < 0 && last[i] < 0) return {1, 0, -1};
    const double zero = first[i] / (first[i] - last[i]);
    if (first[i] < 0) part.begin = std::max(part.begin, zero);
    if (last[i] < 0) part.end = std::min(part.end, zero);
  }
  return part;
}

}  // namespace

double flux_across(const fem::Field& velocity, std::span<const double> points, const fem::Point& from,
                   const fem::Point& to, const std::vector<std::int32_t>& cell_is_marked) {
  constexpr int degree = 5;
  const fem::Space& space = *velocity.space;
  const mesh::Mesh& mesh = *space.mesh;
  const fem::QuadratureRule& rule = fem::quadrature(1, degree);
  const fem::Point normal = {to[1] - from[1], from[0] - to[0], 0};  // times the length
  double sum = 0;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!cell_is_marked[cell]) continue;
    const auto dofs = space.dofs_of(cell);
    std::array<fem::Point, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 2; ++k) corners[i][k] = points[static_cast<std::size_t>(dofs[i]) * 2 + k];
    }
    const Part part = part_inside(corners, from, to);
    if (part.end - part.begin <= rounding) continue;
    const std::int32_t behind =
        part.along < 0 ? -1 : mesh.cell_neighbours[static_cast<std::size_t>(cell) * 3 + part.along];
    const double share = behind >= 0 && cell_is_marked[behind] ? 0.5 : 1;
    const fem::CellMap map(space, points, cell);
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      const double s = part.begin + rule.points[q][1] * (part.end - part.begin);
      const fem::Point point = between(from, to, s);
      // A cell that is curved so much that the point is not in its map has the straight cell's.
      const fem::Barycentric coordinates = map.coordinates_of(point).value_or(straight_coordinates(corners, point));
      for (int k = 0; k < 2; ++k) {
        sum += share * rule.weights[q] * (part.end - part.begin) * normal[k] *
               fem::value_in(velocity, cell, coordinates, k);
      }
    }
  }
  return base::sum(mesh.comm, sum);
}

}  // namespace vocalis::coupling
