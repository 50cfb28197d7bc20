#pragma once

#include <algorithm>
#include <array>
#include <span>

#include "core/fem/simplex.hpp"
#include "coupling/analogies/flow_view.hpp"

namespace vocalis::coupling {

/// A cell of the flow half-way through the step.
template <int Dimension>
fem::SimplexGeometry<Dimension> geometry_of_cell(const FlowView& flow, std::span<const std::int32_t> vertices) {
  std::array<const double*, Dimension + 1> points;
  for (int i = 0; i <= Dimension; ++i) points[i] = flow.coordinates_middle.data() + vertices[i] * Dimension;
  return fem::simplex_geometry<Dimension>(points);
}

inline bool is_silent(const FlowView& flow, std::int32_t vertex) {
  return !flow.vertex_is_silent.empty() && flow.vertex_is_silent[vertex];
}

inline bool has_silent_vertex(const FlowView& flow, std::span<const std::int32_t> vertices) {
  return std::any_of(vertices.begin(), vertices.end(), [&](std::int32_t v) { return is_silent(flow, v); });
}

}  // namespace vocalis::coupling
