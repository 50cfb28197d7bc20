#pragma once

#include <string>
#include <vector>

namespace vocalis::coupling {

/// The arguments of the program, those for PETSc (after "--") apart. Made before base::Session, so that PETSc does not
/// take our options for its own.
struct Arguments {
  Arguments(int argc, char** argv);
  std::vector<std::string> ours;  ///< without the program's name
  std::vector<char*> petsc;       ///< the program's name, PETSc's options, and a null pointer that is not counted
  int petsc_count = 0;
  char** petsc_values = nullptr;  ///< for base::Session session(arguments.petsc_count, arguments.petsc_values)
  Arguments(const Arguments&) = delete;
  Arguments& operator=(const Arguments&) = delete;
};

/// What the user wants.
struct Command {
  enum class Kind { run, check, resume, replay, spectrum, help };
  Kind kind = Kind::help;
  std::string target;                  ///< the case file of run and check; the run folder of the others
  std::vector<std::string> overrides;  ///< "key=value" in order; `--out DIR` is among them as output.directory
  long steps = 0;                      ///< run, resume and replay: stop after so many steps; 0: go to the end
  std::string text;                    ///< what help prints
};

/// Throws UserError (exit code 2) for anything that is not a command, with the usage in the remedy.
Command parse_command(const std::vector<std::string>& arguments);

}  // namespace vocalis::coupling
