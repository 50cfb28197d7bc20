#pragma once

#include <vector>

#include "core/base/log.hpp"
#include "coupling/figures.hpp"

namespace vocalis::coupling {

/// Prints for every microphone: level, pitch, formants with bandwidths, spreads and how they were found, harmonics.
void print_sounds(base::Log& log, const std::vector<ChannelSound>& sounds);

}  // namespace vocalis::coupling
