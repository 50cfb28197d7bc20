#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/io/series_reader.hpp"
#include "coupling/case/case.hpp"

namespace vocalis::coupling {

/// What a run's history says of its voice, cycle by cycle.
struct Phonation {
  std::vector<std::string> columns;         ///< "begin_s", "f0_Hz", "open_quotient", ...: of periods.csv
  std::vector<std::vector<double>> cycles;  ///< one row each; NaN where a cycle has no such figure
  std::map<std::string, double> results;    ///< of the last five cycles: means, but the largest leak; names begin with
                                            ///< the monitor's ("glottis_open_quotient")
};

/// From the first monitor of kind glottis, by its area or else its gap; nothing if there is none. The flow is that of
/// the first monitor of kind flux, or else the one past the folds; in the plane, times the folds' length where the
/// glottis has a depth. Amplitudes are those of all monitors of kind displacement.
Phonation analyse_phonation(const Case& config, const io::Series& history);

/// Writes periods.csv. One rank, not collective. Throws UserError if it cannot be written.
void write_periods(const std::string& path, const Case& config, const Phonation& phonation);

}  // namespace vocalis::coupling
