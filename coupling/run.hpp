#pragma once

#include <mpi.h>

#include "coupling/command_line.hpp"

namespace vocalis::coupling {

// The sub-commands that compute or evaluate. All are collective, return the exit code (0 done, 3 the numerics failed)
// and throw UserError on every rank alike.

/// Computes a case into its run folder.
int run(MPI_Comm comm, const Command& command);

/// Goes on from the last checkpoint of a run folder, as if the run had never stopped.
int resume(MPI_Comm comm, const Command& command);

/// Computes the sound of a run folder's recorded flow anew, into a folder of its own.
int replay(MPI_Comm comm, const Command& command);

/// Evaluates a run folder's microphones again: spectra.csv, .wav and the table of figures.
int spectrum(MPI_Comm comm, const Command& command);

}  // namespace vocalis::coupling
