#pragma once

#include <mpi.h>

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/mpi.hpp"

namespace vocalis::io {

/// Parts of an array that ranks hold: how many numbers each has, and where each begins. MPI counts in `int`.
struct Parts {
  std::vector<int> counts, starts;
  int total = 0;
};

/// Throws std::length_error if there are more than 2^31 - 1 numbers.
Parts make_parts(std::span<const std::int64_t> counts);

/// The parts of all ranks in rank order on rank 0, nothing on the others. Collective.
template <class T>
std::vector<T> gather_to_first(MPI_Comm comm, std::span<const T> mine) {
  const Parts parts = make_parts(base::gather_all(comm, static_cast<std::int64_t>(mine.size())));
  std::vector<T> all(base::rank(comm) == 0 ? parts.total : 0);
  MPI_Gatherv(mine.data(), static_cast<int>(mine.size()), base::type_of<T>(), all.data(), parts.counts.data(),
              parts.starts.data(), base::type_of<T>(), 0, comm);
  return all;
}

/// Each rank's part of what rank 0 holds. `counts` and `all` count on rank 0 only. Collective.
template <class T>
std::vector<T> scatter_from_first(MPI_Comm comm, std::vector<std::int64_t> counts, const std::vector<T>& all) {
  base::broadcast(comm, counts);
  const Parts parts = make_parts(counts);
  std::vector<T> mine(counts[base::rank(comm)]);
  MPI_Scatterv(all.data(), parts.counts.data(), parts.starts.data(), base::type_of<T>(), mine.data(),
               static_cast<int>(mine.size()), base::type_of<T>(), 0, comm);
  return mine;
}

}  // namespace vocalis::io
