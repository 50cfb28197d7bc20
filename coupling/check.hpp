#pragma once

#include <mpi.h>

#include "coupling/command_line.hpp"

namespace vocalis::coupling {

/// Reads and checks a case, makes its mesh, and says what a run would be: the resolved case with units, sizes,
/// unknowns, memory and cost. Nothing is solved. Returns the exit code. Collective; throws UserError on every rank
/// alike.
int check(MPI_Comm comm, const Command& command);

}  // namespace vocalis::coupling
