#pragma once

#include <span>
#include <vector>

#include "contact/wall_distance.hpp"

namespace vocalis::contact {

/// The fluid cells on the medial axis, where two walls are equally near: there |∇D|, the length of the mean of the
/// directions away from both, is at most γ. A cell is on the axis if that holds at one of its corners, or for the mean
/// of two of them: an axis along facets leaves each cell a slope of one. With γ < 1 the bisector of a wedge counts if
/// half its angle is at most arcsin γ, and no cell in a corner of one wall does. A plane of symmetry is an axis where
/// the wall's angle with it is at most arcsin γ. Cells beyond the bound of the distance are not on it.
///
/// Returns one mark an owned cell. Not collective.
/// Source: Degirmenci 2018, Algorithm 2, step 3.
std::vector<char> medial_axis(const WallDistance& walls, double gamma);

}  // namespace vocalis::contact
