#pragma once

#include <mpi.h>

#include <string>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::io {

/// Lets rank 0 do something with files while the others wait. Collective.
template <class Work>
void on_rank_0(const Work& work) {
  MPI_Barrier(MPI_COMM_WORLD);
  if (base::rank(MPI_COMM_WORLD) == 0) work();
  MPI_Barrier(MPI_COMM_WORLD);
}

/// The words of the UserError that the work throws on this rank; empty if it throws none.
template <class Work>
std::string user_error_of(const Work& work) {
  try {
    work();
  } catch (const base::UserError& error) {
    return error.what();
  }
  return {};
}

/// The words of the UserError that the work throws on every rank. Collective.
template <class Work>
std::string error_of(const Work& work) {
  const std::string words = user_error_of(work);
  REQUIRE_ON_ALL_RANKS(!words.empty());
  return words;
}

}  // namespace vocalis::io
