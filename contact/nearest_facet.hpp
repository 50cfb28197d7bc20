#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "contact/walls.hpp"

namespace vocalis::contact {

using Point = std::array<double, 3>;  ///< [m]; 0 beyond the dimension

/// The facet nearest to a point.
struct Nearest {
  std::int32_t facet = -1;                                    ///< -1: none within the bound
  double distance = std::numeric_limits<double>::infinity();  ///< [m]
  Point point = {0, 0, 0};                                    ///< of the facet
};

/// A tree of boxes over the facets of walls: finds the nearest one in the logarithm of their number.
class NearestFacet {
 public:
  /// The walls must outlive the tree.
  explicit NearestFacet(const Walls& walls);

  /// The facet nearest to a point, if nearer than `bound` [m].
  Nearest find(const double* point, double bound = std::numeric_limits<double>::infinity()) const;

 private:
  struct Box {
    std::array<double, 3> low, high;
    std::int32_t begin = 0, end = 0;     ///< of its facets in `order_`
    std::int32_t left = -1, right = -1;  ///< -1: a leaf
  };
  std::int32_t build(std::int32_t begin, std::int32_t end);

  const Walls* walls_;
  std::vector<std::int32_t> order_;
  std::vector<Box> boxes_;
};

/// The point of a facet, given by its corners (dimension, dimension), that is nearest to another one.
/// Source: Ericson 2005, Real-Time Collision Detection, 5.1.5 (the regions of a triangle).
Point nearest_of_facet(int dimension, const double* corners, const double* point);

}  // namespace vocalis::contact
