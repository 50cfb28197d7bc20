#include "coupling/monitors/fold_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/fem/cell_map.hpp"

namespace vocalis::coupling {

namespace {

constexpr double rounding = 1e-9;  // of a step of the grid, of barycentric coordinates, of the interval along the fold

/// A straight triangle.
using Piece = std::array<fem::Point, 3>;

/// The nodes of a facet: its vertices, then the middles of its edges (ab; or ab, ac, bc), if the space has them.
std::vector<fem::Point> nodes_of(const fem::Space& space, std::span<const double> points,
                                 const mesh::NamedFacet& facet) {
  const int d = space.mesh->dimension;
  const auto edges = mesh::edges_of_cell(d);
  const auto dofs = space.dofs_of(facet.cell);
  std::array<int, 3> corners{};
  for (int i = 0, n = 0; i <= d; ++i) {
    if (i != facet.index) corners[n++] = i;
  }
  std::vector<fem::Point> nodes;
  const auto add = [&](int node) {
    fem::Point& point = nodes.emplace_back(fem::Point{0, 0, 0});
    for (int k = 0; k < d; ++k) point[k] = points[static_cast<std::size_t>(dofs[node]) * d + k];
  };
  for (int n = 0; n < d; ++n) add(corners[n]);
  if (space.degree == 1) return nodes;
  for (int a = 0; a < d; ++a) {
    for (int b = a + 1; b < d; ++b) {
      for (std::size_t e = 0; e < edges.size(); ++e) {
        const auto& [first, last] = edges[e];
        if (std::minmax(first, last) == std::minmax(corners[a], corners[b])) add(d + 1 + static_cast<int>(e));
      }
    }
  }
  return nodes;
}

/// The straight triangles of a facet in space.
std::vector<Piece> pieces_of(const std::vector<fem::Point>& nodes) {
  if (nodes.size() == 3) return {{nodes[0], nodes[1], nodes[2]}};
  return {{nodes[0], nodes[3], nodes[4]},
          {nodes[3], nodes[1], nodes[5]},
          {nodes[4], nodes[5], nodes[2]},
          {nodes[3], nodes[4], nodes[5]}};
}

/// The places of stations in an interval: from the first up to and without the second number.
std::array<int, 2> places_in(const Stations& stations, double low, double high) {
  const auto number = [&](double x) { return (x - stations.begin) / stations.step() - 0.5; };
  const double first = std::ceil(number(low) - rounding), last = std::floor(number(high) + rounding);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(stations.count))),
          static_cast<int>(std::clamp(last + 1, 0.0, static_cast<double>(stations.count)))};
}

/// Calls visit(index in the grid, coordinate across) for each place that an interval covers.
template <class Visit>
void for_places_of_interval(const FoldGrid& grid, const fem::Point& a, const fem::Point& b, const Visit& visit) {
  const int x = grid.along.axis;
  const double length = b[x] - a[x];
  if (length == 0) return;  // its neighbours have both ends
  const auto [first, last] = places_in(grid.along, std::min(a[x], b[x]), std::max(a[x], b[x]));
  for (int i = first; i < last; ++i) {
    const double part = std::clamp((grid.along.place(i) - a[x]) / length, 0.0, 1.0);
    visit(static_cast<std::size_t>(i), (1 - part) * a[grid.across] + part * b[grid.across]);
  }
}

/// The same for a triangle.
template <class Visit>
void for_places_of_triangle(const FoldGrid& grid, const Piece& piece, const Visit& visit) {
  const int x = grid.along.axis, z = grid.span.axis;
  const auto doubled_area = [&](const fem::Point& a, const fem::Point& b, const fem::Point& c) {
    return (b[x] - a[x]) * (c[z] - a[z]) - (b[z] - a[z]) * (c[x] - a[x]);
  };
  const double whole = doubled_area(piece[0], piece[1], piece[2]);
  if (whole == 0) return;
  const auto [first, last] = places_in(grid.along, std::min({piece[0][x], piece[1][x], piece[2][x]}),
                                       std::max({piece[0][x], piece[1][x], piece[2][x]}));
  const auto [front, back] = places_in(grid.span, std::min({piece[0][z], piece[1][z], piece[2][z]}),
                                       std::max({piece[0][z], piece[1][z], piece[2][z]}));
  for (int i = first; i < last; ++i) {
    for (int j = front; j < back; ++j) {
      fem::Point place = {0, 0, 0};
      place[x] = grid.along.place(i), place[z] = grid.span.place(j);
      const double a = doubled_area(place, piece[1], piece[2]) / whole;
      const double b = doubled_area(piece[0], place, piece[2]) / whole;
      if (std::min({a, b, 1 - a - b}) < -rounding) continue;
      const int y = grid.across;
      visit(static_cast<std::size_t>(i) * grid.span.count + j,
            a * piece[0][y] + b * piece[1][y] + (1 - a - b) * piece[2][y]);
    }
  }
}

template <class Visit>
void for_places(const fem::Space& space, std::span<const double> points, const mesh::NamedFacet& facet,
                const FoldGrid& grid, const Visit& visit) {
  const std::vector<fem::Point> nodes = nodes_of(space, points, facet);
  if (space.mesh->dimension == 3) {
    for (const Piece& piece : pieces_of(nodes)) for_places_of_triangle(grid, piece, visit);
  } else if (nodes.size() == 2) {
    for_places_of_interval(grid, nodes[0], nodes[1], visit);
  } else {
    for_places_of_interval(grid, nodes[0], nodes[2], visit);
    for_places_of_interval(grid, nodes[2], nodes[1], visit);
  }
}

}  // namespace

FoldProfile fold_profile(const fem::Space& space, std::span<const double> points,
                         const std::vector<mesh::NamedFacet>& facets, const FoldGrid& grid, int side,
                         std::span<const char> in_contact) {
  const MPI_Comm comm = space.mesh->comm;
  FoldProfile profile;
  std::vector<double>& nearest = profile.nearest;
  nearest.assign(grid.size(), std::numeric_limits<double>::infinity());
  for (const mesh::NamedFacet& facet : facets) {
    for_places(space, points, facet, grid,
               [&](std::size_t place, double value) { nearest[place] = std::min(nearest[place], side * value); });
  }
  MPI_Allreduce(MPI_IN_PLACE, nearest.data(), static_cast<int>(nearest.size()), MPI_DOUBLE, MPI_MIN, comm);

  profile.is_sealed.assign(grid.size(), 0);
  const double forgiven = rounding * (grid.along.end - grid.along.begin);
  for (const mesh::NamedFacet& facet : facets) {
    if (in_contact.empty() || !in_contact[facet.cell]) continue;
    for_places(space, points, facet, grid, [&](std::size_t place, double value) {
      if (side * value <= nearest[place] + forgiven) profile.is_sealed[place] = 1;
    });
  }
  MPI_Allreduce(MPI_IN_PLACE, profile.is_sealed.data(), static_cast<int>(grid.size()), MPI_SIGNED_CHAR, MPI_MAX, comm);
  for (double& value : nearest) value *= side;
  return profile;
}

}  // namespace vocalis::coupling
