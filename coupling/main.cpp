#include <mpi.h>

#include <cstdio>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/base/session.hpp"
#include "coupling/check.hpp"
#include "coupling/command_line.hpp"
#include "coupling/run.hpp"

namespace {

using vocalis::coupling::Command;

int carry_out(const Command& command) {
  switch (command.kind) {
    case Command::Kind::run:
      return vocalis::coupling::run(MPI_COMM_WORLD, command);
    case Command::Kind::check:
      return vocalis::coupling::check(MPI_COMM_WORLD, command);
    case Command::Kind::resume:
      return vocalis::coupling::resume(MPI_COMM_WORLD, command);
    case Command::Kind::replay:
      return vocalis::coupling::replay(MPI_COMM_WORLD, command);
    case Command::Kind::spectrum:
      return vocalis::coupling::spectrum(MPI_COMM_WORLD, command);
    case Command::Kind::help:
      if (vocalis::base::rank(MPI_COMM_WORLD) == 0) std::fputs(command.text.c_str(), stdout);
      return 0;
  }
  return 0;
}

}  // namespace

/// Exit codes: 0 done, 2 the user's mistake, 3 the numerics failed.
int main(int argc, char** argv) {
  vocalis::coupling::Arguments arguments(argc, argv);
  const vocalis::base::Session session(arguments.petsc_count, arguments.petsc_values);
  try {
    return carry_out(vocalis::coupling::parse_command(arguments.ours));
  } catch (const vocalis::base::UserError& error) {
    if (vocalis::base::rank(MPI_COMM_WORLD) == 0) std::fprintf(stderr, "vocalis: %s\n", error.what());
    return 2;
  }
}
