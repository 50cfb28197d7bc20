#pragma once

#include <mpi.h>

#include <cstdint>
#include <type_traits>
#include <vector>

namespace vocalis::base {

inline int rank(MPI_Comm comm) {
  int value = 0;
  MPI_Comm_rank(comm, &value);
  return value;
}

inline int size(MPI_Comm comm) {
  int value = 1;
  MPI_Comm_size(comm, &value);
  return value;
}

template <class T>
MPI_Datatype type_of() {
  if constexpr (std::is_same_v<T, double>) {
    return MPI_DOUBLE;
  } else if constexpr (std::is_same_v<T, std::int32_t>) {
    return MPI_INT32_T;
  } else if constexpr (std::is_same_v<T, std::int64_t>) {
    return MPI_INT64_T;
  } else {
    static_assert(std::is_same_v<T, char>, "a type that Vocalis sends");
    return MPI_CHAR;
  }
}

template <class T>
T all_reduce(MPI_Comm comm, T value, MPI_Op operation) {
  T result{};
  MPI_Allreduce(&value, &result, 1, type_of<T>(), operation, comm);
  return result;
}

/// Sum, largest and smallest value over the ranks. Collective.
template <class T>
T sum(MPI_Comm comm, T value) {
  return all_reduce(comm, value, MPI_SUM);
}
template <class T>
T largest(MPI_Comm comm, T value) {
  return all_reduce(comm, value, MPI_MAX);
}
template <class T>
T smallest(MPI_Comm comm, T value) {
  return all_reduce(comm, value, MPI_MIN);
}

/// One value of each rank, in rank order. Collective.
template <class T>
std::vector<T> gather_all(MPI_Comm comm, T value) {
  std::vector<T> values(size(comm));
  MPI_Allgather(&value, 1, type_of<T>(), values.data(), 1, type_of<T>(), comm);
  return values;
}

/// All values of all ranks on every rank, in rank order. Collective.
template <class T>
std::vector<T> concatenate_all(MPI_Comm comm, const std::vector<T>& mine) {
  const std::vector<std::int32_t> counts = gather_all(comm, static_cast<std::int32_t>(mine.size()));
  std::vector<std::int32_t> starts(counts.size() + 1, 0);
  for (std::size_t r = 0; r < counts.size(); ++r) starts[r + 1] = starts[r] + counts[r];
  std::vector<T> all(starts.back());
  MPI_Allgatherv(mine.data(), static_cast<int>(mine.size()), type_of<T>(), all.data(), counts.data(), starts.data(),
                 type_of<T>(), comm);
  return all;
}

/// A vector that `root` holds, on every rank. Collective.
template <class T>
void broadcast(MPI_Comm comm, std::vector<T>& values, int root = 0) {
  std::int64_t count = static_cast<std::int64_t>(values.size());
  MPI_Bcast(&count, 1, MPI_INT64_T, root, comm);
  values.resize(count);
  MPI_Bcast(values.data(), static_cast<int>(count), type_of<T>(), root, comm);
}

/// Sends one list to every rank and returns what each rank sent here: lists[r] goes to r. Collective.
template <class T>
std::vector<std::vector<T>> exchange(MPI_Comm comm, const std::vector<std::vector<T>>& lists) {
  const int ranks = size(comm);
  std::vector<int> send_counts(ranks), receive_counts(ranks), send_starts(ranks + 1, 0), receive_starts(ranks + 1, 0);
  for (int r = 0; r < ranks; ++r) send_counts[r] = static_cast<int>(lists[r].size());
  MPI_Alltoall(send_counts.data(), 1, MPI_INT, receive_counts.data(), 1, MPI_INT, comm);
  for (int r = 0; r < ranks; ++r) {
    send_starts[r + 1] = send_starts[r] + send_counts[r];
    receive_starts[r + 1] = receive_starts[r] + receive_counts[r];
  }
  std::vector<T> outgoing;
  outgoing.reserve(send_starts[ranks]);
  for (const auto& list : lists) outgoing.insert(outgoing.end(), list.begin(), list.end());
  std::vector<T> incoming(receive_starts[ranks]);
  MPI_Alltoallv(outgoing.data(), send_counts.data(), send_starts.data(), type_of<T>(), incoming.data(),
                receive_counts.data(), receive_starts.data(), type_of<T>(), comm);
  std::vector<std::vector<T>> result(ranks);
  for (int r = 0; r < ranks; ++r) {
    result[r].assign(incoming.begin() + receive_starts[r], incoming.begin() + receive_starts[r + 1]);
  }
  return result;
}

}  // namespace vocalis::base
