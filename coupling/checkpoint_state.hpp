#pragma once

#include <string>

#include "coupling/simulation.hpp"

namespace vocalis::coupling {

/// What a resumed run needs beside the states: how long the run had taken.
struct CheckpointFacts {
  double wall_seconds = 0;
};

/// Writes the states of all parts, the clock, and a fingerprint of the mesh. Collective. Throws UserError if the disk
/// does not take it.
void save_checkpoint(const std::string& path, const Case& config, const Scene& scene, Simulation& simulation,
                     const CheckpointFacts& facts);

/// Puts the states of a checkpoint into a simulation of the same case on the same number of ranks. Collective. Throws
/// UserError if it is another case, another mesh or a damaged file.
CheckpointFacts load_checkpoint(const std::string& path, const Case& config, Scene& scene, Simulation& simulation);

}  // namespace vocalis::coupling
