#pragma once

#include <string>

#include "core/la/petsc.hpp"

namespace vocalis::fsi {

/// Factors that all ranks hold parts of (`la::Substructuring`), made anew whenever the operator has changed. A matrix
/// of which some rank cannot eliminate its part is gathered on the first rank and factored there by MUMPS. The
/// preconditioner's name tells which.
///
/// Returns false, and leaves the preconditioner alone, where the dense system between the ranks would take more
/// operations than all the rest: one rank is then as fast. Collective.
bool use_shared_factors(PC preconditioner, Mat matrix, const std::string& prefix);

}  // namespace vocalis::fsi
