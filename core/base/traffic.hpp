#pragma once

#include <mpi.h>

#include <cstdint>

namespace vocalis::base {

/// What one rank sends to others: our own calls, those of PETSc and those of its solvers in C. Communicators of one
/// rank count nothing.
struct Traffic {
  std::int64_t messages = 0;         ///< from one rank to another
  std::int64_t bytes = 0;            ///< of these
  std::int64_t reductions = 0;       ///< calls of a whole communicator: reductions, gathers, broadcasts, barriers
  std::int64_t reduction_bytes = 0;  ///< that this rank hands to these

  Traffic& operator+=(const Traffic& other);
  Traffic& operator-=(const Traffic& other);
  void keep_larger(const Traffic& other);  ///< of each count
};

/// Of this rank since MPI was started; differences tell what a part of the program sent.
Traffic traffic();

/// Each count of the rank that has most. Collective.
Traffic largest(MPI_Comm comm, const Traffic& traffic);

}  // namespace vocalis::base
