#include "core/mesh/geometry.hpp"

#include <cmath>

#include "core/base/mpi.hpp"

namespace vocalis::mesh {

namespace {

std::array<double, 3> difference(int dimension, std::span<const double> coordinates, std::int32_t from,
                                 std::int32_t to) {
  std::array<double, 3> result = {0, 0, 0};
  const double* start = coordinates.data() + static_cast<std::size_t>(from) * dimension;
  const double* end = coordinates.data() + static_cast<std::size_t>(to) * dimension;
  for (int i = 0; i < dimension; ++i) result[i] = end[i] - start[i];
  return result;
}

std::array<double, 3> difference(const Mesh& mesh, std::int32_t from, std::int32_t to) {
  return difference(mesh.dimension, mesh.coordinates, from, to);
}

std::array<double, 3> cross(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

double signed_volume(const Mesh& mesh, std::span<const std::int32_t> vertices) {
  const auto e1 = difference(mesh, vertices[0], vertices[1]);
  const auto e2 = difference(mesh, vertices[0], vertices[2]);
  if (mesh.dimension == 2) return 0.5 * (e1[0] * e2[1] - e1[1] * e2[0]);
  return dot(cross(e1, e2), difference(mesh, vertices[0], vertices[3])) / 6;
}

std::array<std::int32_t, 3> facet_vertices(const Mesh& mesh, std::int32_t cell, int facet) {
  std::array<std::int32_t, 3> result = {-1, -1, -1};
  const auto vertices = mesh.vertices_of(cell);
  for (int i = 0, n = 0; i <= mesh.dimension; ++i) {
    if (i != facet) result[n++] = vertices[i];
  }
  return result;
}

FacetGeometry facet_geometry(const Mesh& mesh, std::int32_t cell, int facet) {
  const auto corners = facet_vertices(mesh, cell, facet);
  const auto edge = difference(mesh, corners[0], corners[1]);
  FacetGeometry result;
  if (mesh.dimension == 2) {
    result.normal = {edge[1], -edge[0], 0};
  } else {
    result.normal = cross(edge, difference(mesh, corners[0], corners[2]));
  }
  const double length = std::sqrt(dot(result.normal, result.normal));
  const auto inward = difference(mesh, corners[0], mesh.vertices_of(cell)[facet]);
  const double sign = dot(inward, result.normal) > 0 ? -1 : 1;
  for (double& component : result.normal) component *= sign / length;
  result.measure = mesh.dimension == 2 ? length : 0.5 * length;
  return result;
}

double quality(const Mesh& mesh, std::int32_t cell) { return quality(mesh, cell, mesh.coordinates); }

double quality(const Mesh& mesh, std::int32_t cell, std::span<const double> coordinates) {
  const int d = mesh.dimension;
  const auto vertices = mesh.vertices_of(cell);
  std::array<std::array<double, 3>, 4> edges = {};  // from the first vertex
  // |F|² for F = E R⁻¹ with the regular simplex R of unit edges is, up to a constant, the sum of squared edge lengths.
  double squares = 0;
  for (int i = 0; i <= d; ++i) {
    for (int j = 0; j < i; ++j) {
      const auto edge = difference(mesh.dimension, coordinates, vertices[j], vertices[i]);
      squares += dot(edge, edge);
      if (j == 0) edges[i] = edge;
    }
  }
  const double volume = d == 2 ? 0.5 * cross(edges[1], edges[2])[2] : dot(cross(edges[1], edges[2]), edges[3]) / 6;
  const double regular_volume = d == 2 ? std::sqrt(3.0) / 4 : std::sqrt(2.0) / 12;
  const double ratio = volume / regular_volume;
  return std::copysign((d == 2 ? 3 : 6) * std::pow(std::abs(ratio), 2.0 / d) / squares, ratio);
}

double smallest_quality(const Mesh& mesh) {
  double lowest = 1;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) lowest = std::min(lowest, quality(mesh, cell));
  return base::smallest(mesh.comm, lowest);
}

}  // namespace vocalis::mesh
