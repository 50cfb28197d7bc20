#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/io/series_writer.hpp"
#include "coupling/simulation.hpp"

namespace vocalis::coupling {

/// The columns of history.csv.
std::vector<std::string> history_columns(const Simulation& simulation);

/// The columns of one acoustic solver's microphones.csv.
std::vector<std::string> microphone_columns(const Case& config, std::size_t solver);

/// What a reader of that file alone must know: units, what p is, of which medium, where.
///
/// in_flow  whether each microphone is in the flow
io::SeriesWriter::Header microphone_header(const Case& config, std::size_t solver,
                                           const std::vector<std::int32_t>& in_flow);

/// A step, its time, and the opening at each station: "opening_m.0.0123" where x = 0.0123 m.
std::vector<std::string> kymogram_columns(const Stations& stations);

io::SeriesWriter::Header kymogram_header(const Case& config, const Glottis& glottis);

}  // namespace vocalis::coupling
