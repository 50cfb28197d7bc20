#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/base/log.hpp"
#include "core/base/timers.hpp"
#include "coupling/case/case.hpp"
#include "coupling/figures.hpp"

namespace vocalis::coupling {

/// The facts of a run that summary.json holds besides its figures.
struct RunFacts {
  std::string status = "running";  ///< running, finished, stopped, failed
  std::string reason;              ///< why it stopped or failed
  int ranks = 1;
  int dimension = 2;
  long steps = 0;
  long rejected_steps = 0;
  double simulated_seconds = 0;
  double wall_seconds = 0;                              ///< of all parts of a run that was resumed
  std::map<std::string, std::int64_t> cells, unknowns;  ///< by mesh: parent, flow, acoustic; acoustic.NAME
                                                        ///< of an [[acoustic]] with a mesh of its own
  std::map<std::string, double> imbalance;              ///< by mesh: see Balance
  std::vector<base::Timers::Phase> phases;
  base::Traffic traffic;   ///< of all steps, where the phases' counts are parts of it; largest over the ranks
  long counted_steps = 0;  ///< in which phases and traffic were: of this part of a run that was resumed
  std::map<std::string, double> contact;  ///< what it did; empty where walls cannot touch
  double peak_memory_bytes = 0;           ///< sum over the ranks
};

/// Writes summary.json; what the case expects is set beside what was found. One rank, not collective. Throws
/// UserError if it cannot be written.
void write_summary(const std::string& path, const Case& config, const RunFacts& facts, const Figures& figures);

/// The table at the end of a run: figures, what the case expects, wall time by phase.
void print_table(base::Log& log, const Case& config, const RunFacts& facts, const Figures& figures);

/// Largest resident memory of this process [bytes].
double peak_memory_bytes();

}  // namespace vocalis::coupling
