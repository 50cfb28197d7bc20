#pragma once

#include <petscsystypes.h>

#include <source_location>
#include <stdexcept>
#include <string>

namespace vocalis::base {

/// The user's mistake: the rule, the value found and what to do. Thrown on every rank alike; `main` prints it once and
/// ends with exit code 2.
class UserError : public std::runtime_error {
 public:
  explicit UserError(const std::string& message) : std::runtime_error(message) {}
  /// "RULE; found VALUE; REMEDY"
  UserError(const std::string& rule, const std::string& value, const std::string& remedy)
      : std::runtime_error(rule + "\n  found: " + value + "\n  remedy: " + remedy) {}
};

/// Turns a PETSc error code into an exception that names file and line. Our mistake or PETSc's, never the user's.
void check(PetscErrorCode code, std::source_location where = std::source_location::current());

}  // namespace vocalis::base
