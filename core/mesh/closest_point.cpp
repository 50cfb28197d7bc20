#include "core/mesh/closest_point.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/mesh/locate.hpp"

namespace vocalis::mesh {

namespace {

using Point = std::array<double, 3>;

Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Corners of a cell and which of them make the face that is looked at.
struct Face {
  std::array<Point, 4> corners;
  std::vector<int> which;
};

/// Barycentric coordinates, by index of the cell's corners, of the projection onto the plane, line or corner that the
/// face spans.
std::array<double, 4> project(const Face& face, const Point& point) {
  std::array<double, 4> result = {0, 0, 0, 0};
  const auto corner = [&](int i) { return face.corners[face.which[i]]; };
  if (face.which.size() == 1) {
    result[face.which[0]] = 1;
  } else if (face.which.size() == 2) {
    const Point edge = corner(1) - corner(0);
    const double part = dot(point - corner(0), edge) / dot(edge, edge);
    result[face.which[0]] = 1 - part;
    result[face.which[1]] = part;
  } else {
    const Point a = corner(1) - corner(0), b = corner(2) - corner(0), r = point - corner(0);
    const double aa = dot(a, a), ab = dot(a, b), bb = dot(b, b), ra = dot(r, a), rb = dot(r, b);
    const double determinant = aa * bb - ab * ab;
    const double first = (ra * bb - rb * ab) / determinant, second = (rb * aa - ra * ab) / determinant;
    result[face.which[0]] = 1 - first - second;
    result[face.which[1]] = first;
    result[face.which[2]] = second;
  }
  return result;
}

double distance(const Face& face, const std::array<double, 4>& weights, const Point& point) {
  Point there = {0, 0, 0};
  for (const int i : face.which) {
    for (int k = 0; k < 3; ++k) there[k] += weights[i] * face.corners[i][k];
  }
  return std::sqrt(dot(point - there, point - there));
}

ClosestPoint closest_on(const Face& face, const Point& point);

/// The nearest point is on a side opposite to a corner whose coordinate is negative.
ClosestPoint closest_on_sides(const Face& face, const std::array<double, 4>& weights, const Point& point) {
  ClosestPoint best = {.distance = std::numeric_limits<double>::infinity()};
  for (const int corner : face.which) {
    if (weights[corner] >= 0) continue;
    Face side = face;
    std::erase(side.which, corner);
    const ClosestPoint there = closest_on(side, point);
    if (there.distance < best.distance) best = there;
  }
  return best;
}

ClosestPoint closest_on(const Face& face, const Point& point) {
  const std::array<double, 4> weights = project(face, point);
  const bool inside = *std::min_element(weights.begin(), weights.end()) >= 0;
  return inside ? ClosestPoint{weights, distance(face, weights, point)} : closest_on_sides(face, weights, point);
}

}  // namespace

ClosestPoint closest_point(const Mesh& mesh, std::int32_t cell, const std::array<double, 3>& point) {
  constexpr double rounding = 1e-10;
  const std::array<double, 4> weights = barycentric_coordinates(mesh, cell, point);
  if (*std::min_element(weights.begin(), weights.begin() + mesh.dimension + 1) >= -rounding) return {weights, 0};
  Face whole{};
  for (int i = 0; i <= mesh.dimension; ++i) {
    std::copy_n(mesh.point(mesh.vertices_of(cell)[i]), mesh.dimension, whole.corners[i].begin());
    whole.which.push_back(i);
  }
  return closest_on_sides(whole, weights, point);
}

}  // namespace vocalis::mesh
