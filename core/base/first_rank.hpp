#pragma once

#include <mpi.h>

#include <functional>

namespace vocalis::base {

/// Does something on rank 0 alone. A UserError there is thrown on every rank, with the same words. Collective; the work
/// must not communicate.
void on_first_rank(MPI_Comm comm, const std::function<void()>& work);

}  // namespace vocalis::base
