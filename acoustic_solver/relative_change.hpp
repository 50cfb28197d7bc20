#pragma once

#include <mpi.h>

namespace vocalis::acoustic {

/// Whether a change is at most this part of a size, by 2-norms of whose squares each rank has its share: one message.
/// Collective.
bool is_small_change(MPI_Comm comm, double change_squared, double size_squared, double part);

}  // namespace vocalis::acoustic
