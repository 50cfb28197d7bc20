#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/io/fields_writer.hpp"
#include "core/io/series_writer.hpp"
#include "coupling/simulation.hpp"

namespace vocalis::coupling {

/// Makes a run folder, or takes what an earlier run left out of it. Collective. Throws UserError if it cannot be made.
void prepare_run_folder(MPI_Comm comm, const std::string& folder);

/// What a run writes while it goes: history.csv, microphones.csv (microphones_NAME.csv for a second acoustic solver and
/// more), kymogram_NAME.csv of each glottis and the fields.
class RunOutput {
 public:
  /// goes_on  the files of the run so far are cut after the present step, and continued
  /// Collective. Throws UserError if the files cannot be written.
  RunOutput(const Case& config, const std::string& folder, const Scene& scene, Simulation& simulation, bool goes_on);

  /// Records an accepted step; writes the fields if they are due. Collective.
  void record(Simulation& simulation, const StepOutcome& outcome);
  /// Brings all that was recorded to the disk. Collective. Throws UserError if the disk does not take it.
  void flush(Simulation& simulation);

 private:
  void record_microphones(Simulation& simulation);
  void record_kymograms(Simulation& simulation);
  void write_fields(Simulation& simulation);

  const Case& config_;
  const Scene& scene_;
  std::unique_ptr<io::SeriesWriter> history_;
  std::vector<std::unique_ptr<io::SeriesWriter>> microphones_;
  std::unique_ptr<io::SeriesWriter> surface_microphones_;     ///< none without such microphones
  std::vector<std::unique_ptr<io::SeriesWriter>> kymograms_;  ///< of each glottis
  std::unique_ptr<io::FieldsWriter> fields_;
  fem::Space parent_space_;  ///< this and what follows: for the fields
  std::optional<transfer::SharedVertices> flow_to_parent_;
  std::vector<std::int32_t> vertex_is_wet_;  ///< of the flow mesh
};

}  // namespace vocalis::coupling
