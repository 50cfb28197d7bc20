#include "core/base/error.hpp"

#include <petscsys.h>

namespace vocalis::base {

void check(PetscErrorCode code, std::source_location where) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string(where.file_name()) + ":" + std::to_string(where.line()) + ": PETSc error " +
                           std::to_string(code) + ": " + (text ? text : "unknown"));
}

}  // namespace vocalis::base
