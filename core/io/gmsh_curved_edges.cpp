#include "core/io/gmsh_curved_edges.hpp"

#include <fmt/format.h>
#include <gmsh.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>

#include "core/base/error.hpp"
#include "core/fem/simplex.hpp"

namespace vocalis::io {

namespace {

using Point = std::array<double, 3>;

/// Coordinates of all nodes by their tags.
std::unordered_map<std::size_t, Point> node_points() {
  std::vector<std::size_t> tags;
  std::vector<double> points, parameters;
  gmsh::model::mesh::getNodes(tags, points, parameters);
  std::unordered_map<std::size_t, Point> result;
  result.reserve(tags.size());
  for (std::size_t i = 0; i < tags.size(); ++i) {
    result.emplace(tags[i], Point{points[3 * i], points[3 * i + 1], points[3 * i + 2]});
  }
  return result;
}

/// Corners of a cell, then the middles of its edges, (6 or 10, dimension) [m], and whether any of them is curved.
bool collect_points(const mesh::WholeMesh& mesh, std::int64_t cell,
                    const std::map<std::array<std::int64_t, 2>, std::size_t>& curved, std::vector<double>& points) {
  const int d = mesh.dimension;
  const std::int64_t* vertices = mesh.cell_vertices.data() + cell * (d + 1);
  points.clear();
  for (int i = 0; i <= d; ++i) {
    const auto first = mesh.coordinates.begin() + vertices[i] * d;
    points.insert(points.end(), first, first + d);
  }
  bool any = false;
  for (const auto& [a, b] : mesh::edges_of_cell(d)) {
    const auto found = curved.find({std::min(vertices[a], vertices[b]), std::max(vertices[a], vertices[b])});
    any = any || found != curved.end();
    for (int k = 0; k < d; ++k) {
      points.push_back(found != curved.end() ? mesh.curved_points[found->second * d + k]
                                             : 0.5 * (points[a * d + k] + points[b * d + k]));
    }
  }
  return any;
}

/// Jacobian determinant of the P2 map [m^2, m^3] at a point of the cell.
double determinant(int d, const std::vector<double>& points, const std::array<double, 4>& at) {
  const int dofs = static_cast<int>(points.size()) / d;
  std::array<double, 40> derivatives{};
  fem::basis_derivatives(d, 2, at, {derivatives.data(), static_cast<std::size_t>(dofs * (d + 1))});
  std::array<Point, 3> F = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int k = 0; k < d; ++k) {
    for (int l = 0; l < d; ++l) {
      F[k][l] = 0;
      for (int a = 0; a < dofs; ++a) {
        F[k][l] += points[a * d + k] * (derivatives[a * (d + 1) + l + 1] - derivatives[a * (d + 1)]);
      }
    }
  }
  return F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) - F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
         F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
}

void check_cells(const std::string& path, const mesh::WholeMesh& mesh) {
  const int d = mesh.dimension;
  std::map<std::array<std::int64_t, 2>, std::size_t> curved;
  for (std::size_t i = 0; 2 * i < mesh.curved_edges.size(); ++i) {
    curved[{mesh.curved_edges[2 * i], mesh.curved_edges[2 * i + 1]}] = i;
  }
  std::vector<std::array<double, 4>> samples(d + 1, {0, 0, 0, 0});
  for (int i = 0; i <= d; ++i) samples[i][i] = 1;
  for (const auto& [a, b] : mesh::edges_of_cell(d)) {
    samples.push_back({0, 0, 0, 0});
    samples.back()[a] = samples.back()[b] = 0.5;
  }
  std::vector<double> points;
  for (std::int64_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (!collect_points(mesh, cell, curved, points)) continue;
    for (const auto& sample : samples) {
      if (determinant(d, points, sample) > 0) continue;
      throw base::UserError(path + ": cells with curved edges must not be turned inside out",
                            fmt::format("one in region \"{}\" near ({})", mesh.region_names[mesh.cell_region[cell]],
                                        fmt::join(points.begin(), points.begin() + d, ", ")),
                            "make the mesh finer there, or give flow.elements = \"P1P1\", whose cells are straight");
    }
  }
}

}  // namespace

void add_curved_edges(const std::string& path, std::vector<EdgeMiddle> middles, mesh::WholeMesh& mesh) {
  if (middles.empty()) return;
  const int d = mesh.dimension;
  const auto key = [](const EdgeMiddle& edge) { return std::tie(edge.first, edge.second); };
  for (EdgeMiddle& edge : middles) {
    if (edge.first > edge.second) std::swap(edge.first, edge.second);
  }
  std::sort(middles.begin(), middles.end(), [&](const auto& a, const auto& b) { return key(a) < key(b); });
  const auto end =
      std::unique(middles.begin(), middles.end(), [&](const auto& a, const auto& b) { return key(a) == key(b); });
  middles.erase(end, middles.end());
  const std::unordered_map<std::size_t, Point> points = node_points();
  for (const EdgeMiddle& edge : middles) {
    const Point& point = points.at(edge.node);
    const double *a = mesh.coordinates.data() + edge.first * d, *b = mesh.coordinates.data() + edge.second * d;
    double deviation = 0, length = 0;
    for (int k = 0; k < d; ++k) {
      deviation = std::hypot(deviation, point[k] - 0.5 * (a[k] + b[k]));
      length = std::hypot(length, b[k] - a[k]);
    }
    if (!std::isfinite(deviation)) {
      throw base::UserError(path + ": coordinates must be finite numbers",
                            fmt::format("({}) at node {}", fmt::join(point, ", "), edge.node),
                            "correct the mesh file, or the geometry's formulas");
    }
    if (deviation <= 1e-10 * length) continue;
    mesh.curved_edges.insert(mesh.curved_edges.end(), {edge.first, edge.second});
    mesh.curved_points.insert(mesh.curved_points.end(), point.begin(), point.begin() + d);
  }
  check_cells(path, mesh);
}

}  // namespace vocalis::io
