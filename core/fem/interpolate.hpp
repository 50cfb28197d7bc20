#pragma once

#include <functional>
#include <span>

#include "core/fem/field.hpp"

namespace vocalis::fem {

/// A function of the point: reads `dimension` coordinates [m], writes its values.
using PointFunction = std::function<void(std::span<const double> point, std::span<double> values)>;

/// The Lagrange interpolant: the function at every local dof, ghosts too, so that no messages are needed.
Field interpolate(const Space& space, int components, const PointFunction& function);

}  // namespace vocalis::fem
