#pragma once

#include <vector>

#include "core/la/petsc.hpp"

namespace vocalis::la {

/// Global rows, ascending and on every rank, without which no unknown of one rank couples with one of another: those
/// that couple with an unknown of a higher rank, in their row or in their column. Where the lowest rank owns what
/// several share, as in our meshes, these are the shared unknowns. Collective.
std::vector<PetscInt> find_separator(Mat matrix);

}  // namespace vocalis::la
