#include "core/base/session.hpp"

#include <petscsys.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

namespace vocalis::base {

namespace {

/// Ends all ranks at once when an exception finds no handler: unwinding would run collective destructors on one rank.
[[noreturn]] void abort_all_ranks() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  try {
    if (const auto error = std::current_exception()) std::rethrow_exception(error);
    std::fprintf(stderr, "vocalis, rank %d: terminated\n", rank);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "vocalis, rank %d: %s\n", rank, error.what());
  } catch (...) {
    std::fprintf(stderr, "vocalis, rank %d: unknown exception\n", rank);
  }
  std::fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();
}

}  // namespace

Session::Session(int& argc, char**& argv) {
  if (PetscInitialize(&argc, &argv, nullptr, nullptr) != 0) std::abort();
  PetscPushErrorHandler(PetscReturnErrorHandler, nullptr);
  PetscPopSignalHandler();
  std::set_terminate(abort_all_ranks);
}

Session::~Session() { PetscFinalize(); }

}  // namespace vocalis::base
