#include "core/fem/facet_integrals.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/fem/cell_map.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::fem {

namespace {

/// Whether a normal points towards larger x, or y if it has no x, ...
bool points_ahead(const Point& normal) {
  for (const double component : normal) {
    if (std::abs(component) > 1e-9) return component > 0;
  }
  return true;
}

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

/// n ds for the weights of a quadrature rule: the outward normal times the facet's measure as it is at one point.
Point area_vector(const std::array<Point, 4>& derivatives, int dimension, int facet) {
  std::array<Point, 3> along{};
  for (int i = 0, n = 0; i <= dimension; ++i) {
    if (i != facet) along[n++] = derivatives[i];
  }
  const Point a = difference(along[1], along[0]);
  Point result = {a[1], -a[0], 0};
  if (dimension == 3) {
    const Point b = difference(along[2], along[0]);
    result = {0.5 * (a[1] * b[2] - a[2] * b[1]), 0.5 * (a[2] * b[0] - a[0] * b[2]), 0.5 * (a[0] * b[1] - a[1] * b[0])};
  }
  const double sign = dot(result, difference(derivatives[facet], along[0])) > 0 ? -1 : 1;
  for (double& component : result) component *= sign;
  return result;
}

/// A point of a facet's rule as a point of the cell.
Barycentric in_cell(const std::array<double, 4>& on_facet, int dimension, int facet) {
  Barycentric result = {0, 0, 0, 0};
  for (int i = 0, n = 0; i <= dimension; ++i) {
    if (i != facet) result[i] = on_facet[n++];
  }
  return result;
}

}  // namespace

std::vector<mesh::NamedFacet> facets_seen_once(const mesh::Mesh& mesh, const std::string& group) {
  std::vector<mesh::NamedFacet> facets = mesh::facets_of_group(mesh, group);
  std::erase_if(facets, [&](const mesh::NamedFacet& facet) {
    const std::size_t place = static_cast<std::size_t>(facet.cell) * (mesh.dimension + 1) + facet.index;
    return mesh.cell_neighbours[place] >= 0 &&
           !points_ahead(mesh::facet_geometry(mesh, facet.cell, facet.index).normal);
  });
  return facets;
}

double flux_through(const Field& velocity, std::span<const double> points,
                    const std::vector<mesh::NamedFacet>& facets) {
  constexpr int degree = 4;  // of v·n ds on a curved face of a tetrahedron
  const Space& space = *velocity.space;
  const int d = space.mesh->dimension;
  const QuadratureRule& rule = quadrature(d - 1, degree);
  double sum = 0;
  for (const mesh::NamedFacet& facet : facets) {
    const CellMap map(space, points, facet.cell);
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      const Barycentric coordinates = in_cell(rule.points[q], d, facet.index);
      const Point area = area_vector(map.derivatives(coordinates), d, facet.index);
      for (int k = 0; k < d; ++k) {
        sum += rule.weights[q] * area[k] * value_in(velocity, facet.cell, coordinates, k);
      }
    }
  }
  return base::sum(space.mesh->comm, sum);
}

double gap_to_plane(const Space& space, std::span<const double> points, const std::vector<mesh::NamedFacet>& facets,
                    int axis, double plane) {
  const int d = space.mesh->dimension;
  const auto edges = mesh::edges_of_cell(d);
  double smallest = std::numeric_limits<double>::infinity();
  for (const mesh::NamedFacet& facet : facets) {
    const auto dofs = space.dofs_of(facet.cell);
    for (int i = 0; i < space.dofs_per_cell; ++i) {
      const bool at_vertex = i <= d;
      const bool on_facet =
          at_vertex ? i != facet.index : edges[i - d - 1][0] != facet.index && edges[i - d - 1][1] != facet.index;
      if (!on_facet) continue;
      smallest = std::min(smallest, std::abs(points[static_cast<std::size_t>(dofs[i]) * d + axis] - plane));
    }
  }
  return base::smallest(space.mesh->comm, smallest);
}

}  // namespace vocalis::fem
