#pragma once

#include <memory>
#include <string>

#include "core/io/series_writer.hpp"
#include "coupling/far_field/surface_microphones.hpp"

namespace vocalis::coupling {

/// The file of microphones that hear surfaces of the flow: "microphones.csv" where there are no others.
std::string surface_microphones_file(const Case& config);

/// Opens that file, or one of the run so far, which is cut after a time [s]. Collective. Throws UserError if it cannot
/// be written.
std::unique_ptr<io::SeriesWriter> open_surface_series(MPI_Comm comm, const Case& config, const std::string& folder,
                                                      double last, bool goes_on);

/// Writes what was heard since the last time. Collective.
void write_surface_series(SurfaceMicrophones& microphones, io::SeriesWriter& series);

}  // namespace vocalis::coupling
