#pragma once

#include <array>
#include <optional>
#include <span>

#include "core/fem/field.hpp"

namespace vocalis::fem {

using Point = std::array<double, 3>;        ///< [m]; the first `dimension` count
using Barycentric = std::array<double, 4>;  ///< the first dimension + 1 count

/// The isoparametric map of one cell, x(λ) = Σ N_i(λ) x_i, wherever the dofs of its space are: in the reference, or
/// moved.
class CellMap {
 public:
  /// points  (dofs, dimension) [m] of all dofs of the space
  CellMap(const Space& space, std::span<const double> points, std::int32_t cell);

  Point at(const Barycentric& coordinates) const;
  /// ∂x/∂λ_i, one vector a corner.
  std::array<Point, 4> derivatives(const Barycentric& coordinates) const;
  /// λ of a point in or near the cell, by Newton's iteration from the straight cell; none if that does not converge.
  std::optional<Barycentric> coordinates_of(const Point& point) const;

 private:
  int dimension_, degree_;
  int nodes_;
  std::array<Point, 10> points_;
};

/// The value of one component of a field in a cell where it has unknowns.
double value_in(const Field& field, std::int32_t cell, const Barycentric& coordinates, int component);

}  // namespace vocalis::fem
