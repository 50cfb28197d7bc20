#pragma once

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace vocalis::acoustic {

/// Throws UserError unless a rule about a number of a source holds.
inline void demand(bool holds, const char* rule, double value, const char* remedy) {
  if (!holds) throw base::UserError(rule, fmt::format("{}", value), remedy);
}

}  // namespace vocalis::acoustic
