#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/base/timers.hpp"
#include "coupling/figures.hpp"
#include "coupling/simulation.hpp"
#include "coupling/summary.hpp"

namespace vocalis::coupling {

/// What is known of a run before its first step: ranks, cells, unknowns, balance. Collective.
RunFacts facts_of_scene(const Case& config, const Scene& scene, const Simulation& simulation);

/// Wall seconds and traffic of all parts on this rank, by phase. `timers` are those of the step.
std::vector<base::Timers::Phase> phases_of(const Simulation& simulation, const base::Timers& timers);

/// What contact did, by the names of summary.json.
std::map<std::string, double> figures_of(const ContactReport& report);

/// Adds what stripping the air anew did to the sound of each voice.
void add_rebuilds(const Case& config, const Simulation& simulation, Figures& figures);

}  // namespace vocalis::coupling
