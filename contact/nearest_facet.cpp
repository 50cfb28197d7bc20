#include "contact/nearest_facet.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vocalis::contact {

namespace {

constexpr std::int32_t kLeafFacets = 4;

double dot(const double* a, const double* b, int d) { return std::inner_product(a, a + d, b, 0.0); }

Point nearest_of_segment(int d, const double* a, const double* b, const double* point) {
  double along[3] = {}, to[3] = {};
  for (int k = 0; k < d; ++k) along[k] = b[k] - a[k], to[k] = point[k] - a[k];
  const double square = dot(along, along, d);
  const double part = square > 0 ? std::clamp(dot(along, to, d) / square, 0.0, 1.0) : 0.0;
  Point nearest = {0, 0, 0};
  for (int k = 0; k < d; ++k) nearest[k] = a[k] + part * along[k];
  return nearest;
}

double square_of_distance(int d, const Point& a, const double* b) {
  double square = 0;
  for (int k = 0; k < d; ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return square;
}

/// Inside of the prism over a triangle the nearest point lies in its plane, else on one of its edges.
Point nearest_of_triangle(const double* corners, const double* point) {
  const double *a = corners, *b = corners + 3, *c = corners + 6;
  double ab[3], ac[3], ap[3];
  for (int k = 0; k < 3; ++k) ab[k] = b[k] - a[k], ac[k] = c[k] - a[k], ap[k] = point[k] - a[k];
  const double bb = dot(ab, ab, 3), bc = dot(ab, ac, 3), cc = dot(ac, ac, 3);
  const double pb = dot(ap, ab, 3), pc = dot(ap, ac, 3);
  const double determinant = bb * cc - bc * bc;
  const double v = cc * pb - bc * pc, w = bb * pc - bc * pb;
  if (v >= 0 && w >= 0 && v + w <= determinant && determinant > 0) {
    Point nearest;
    for (int k = 0; k < 3; ++k) nearest[k] = a[k] + (v * ab[k] + w * ac[k]) / determinant;
    return nearest;
  }
  const Point of_edges[] = {nearest_of_segment(3, a, b, point), nearest_of_segment(3, b, c, point),
                            nearest_of_segment(3, c, a, point)};
  return *std::min_element(of_edges, of_edges + 3, [point](const Point& one, const Point& other) {
    return square_of_distance(3, one, point) < square_of_distance(3, other, point);
  });
}

}  // namespace

Point nearest_of_facet(int dimension, const double* corners, const double* point) {
  return dimension == 2 ? nearest_of_segment(2, corners, corners + 2, point) : nearest_of_triangle(corners, point);
}

NearestFacet::NearestFacet(const Walls& walls) : walls_(&walls), order_(walls.num_facets()) {
  std::iota(order_.begin(), order_.end(), 0);
  boxes_.reserve(order_.size());
  if (!order_.empty()) build(0, static_cast<std::int32_t>(order_.size()));
}

std::int32_t NearestFacet::build(std::int32_t begin, std::int32_t end) {
  const int d = walls_->dimension;
  const auto index = static_cast<std::int32_t>(boxes_.size());
  Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, begin, end, -1, -1};
  for (std::int32_t i = begin; i < end; ++i) {
    const double* corners = walls_->corners.data() + static_cast<std::size_t>(order_[i]) * d * d;
    for (int c = 0; c < d * d; ++c) {
      box.low[c % d] = std::min(box.low[c % d], corners[c]);
      box.high[c % d] = std::max(box.high[c % d], corners[c]);
    }
  }
  boxes_.push_back(box);
  if (end - begin <= kLeafFacets) return index;
  int widest = 0;
  for (int k = 1; k < d; ++k) {
    if (box.high[k] - box.low[k] > box.high[widest] - box.low[widest]) widest = k;
  }
  const auto middle_of = [&](std::int32_t facet) {
    double sum = 0;
    for (int c = 0; c < d; ++c) sum += walls_->corners[(static_cast<std::size_t>(facet) * d + c) * d + widest];
    return sum;
  };
  const std::int32_t middle = (begin + end) / 2;
  std::nth_element(order_.begin() + begin, order_.begin() + middle, order_.begin() + end,
                   [&](std::int32_t a, std::int32_t b) { return middle_of(a) < middle_of(b); });
  const std::int32_t left = build(begin, middle);
  const std::int32_t right = build(middle, end);
  boxes_[index].left = left;
  boxes_[index].right = right;
  return index;
}

Nearest NearestFacet::find(const double* point, double bound) const {
  const int d = walls_->dimension;
  Nearest nearest{-1, bound, {0, 0, 0}};
  if (boxes_.empty()) return {};
  const auto distance_from_box = [&](const Box& box) {
    double square = 0;
    for (int k = 0; k < d; ++k) {
      const double outside = std::max({box.low[k] - point[k], point[k] - box.high[k], 0.0});
      square += outside * outside;
    }
    return std::sqrt(square);
  };
  std::array<std::int32_t, 64> waiting;  // a balanced tree is not deeper
  int count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const Box& box = boxes_[waiting[--count]];
    if (distance_from_box(box) >= nearest.distance) continue;
    if (box.left < 0) {
      for (std::int32_t i = box.begin; i < box.end; ++i) {
        const double* corners = walls_->corners.data() + static_cast<std::size_t>(order_[i]) * d * d;
        const Point of_facet = nearest_of_facet(d, corners, point);
        const double distance = std::sqrt(square_of_distance(d, of_facet, point));
        if (distance < nearest.distance) nearest = {order_[i], distance, of_facet};
      }
      continue;
    }
    const bool left_first = distance_from_box(boxes_[box.left]) < distance_from_box(boxes_[box.right]);
    waiting[count++] = left_first ? box.right : box.left;
    waiting[count++] = left_first ? box.left : box.right;
  }
  return nearest.facet < 0 ? Nearest{} : nearest;
}

}  // namespace vocalis::contact
