#pragma once

#include <mpi.h>

#include <string>

namespace vocalis::coupling {

/// Makes a run folder, or takes what an earlier run left out of it. Collective. Throws UserError if it cannot be made.
void prepare_run_folder(MPI_Comm comm, const std::string& folder);

}  // namespace vocalis::coupling
