#pragma once

#include <string>

#include "core/la/petsc.hpp"

namespace vocalis::fsi {

/// How often a factorisation is used: MUMPS factors fast, PETSc's own factors (nested dissection) solve fast.
enum class Reuse { few_solves, many_solves };

/// Factors of the whole system on the first rank. Collective.
void use_gathered_factors(PC preconditioner, const std::string& prefix, Reuse reuse);

}  // namespace vocalis::fsi
