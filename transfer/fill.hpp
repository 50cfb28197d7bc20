#pragma once

#include <cstdint>
#include <vector>

#include "core/fem/field.hpp"

namespace vocalis::transfer {

/// Gives the vertices of a mesh that have no value of their own the mean of their neighbours (along edges) that have
/// one, in sweeps from the known ones inwards and over all again, towards a field without extrema of its own; 0 where
/// no way leads to a known vertex. Linear in the known values.
///
/// field     P1, ghosts current; so they are on exit
/// is_known  (vertices) not 0 where the value stays, to the last bit; ghosts current
/// Collective.
void fill(fem::Field& field, const std::vector<std::int32_t>& is_known);

}  // namespace vocalis::transfer
