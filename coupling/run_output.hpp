#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/io/fields_writer.hpp"
#include "core/io/record_writer.hpp"
#include "core/io/series_writer.hpp"
#include "coupling/simulation.hpp"

namespace vocalis::coupling {

/// What a run writes while it goes: history.csv, microphones.csv (microphones_NAME.csv for a second acoustic solver and
/// more), kymogram_NAME.csv of each glottis, the fields and the record of the flow.
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
  void record_flow(Simulation& simulation);

  const Case& config_;
  const Scene& scene_;
  std::unique_ptr<io::SeriesWriter> history_;
  std::vector<std::unique_ptr<io::SeriesWriter>> microphones_;
  std::unique_ptr<io::SeriesWriter> surface_microphones_;     ///< none without such microphones
  std::vector<std::unique_ptr<io::SeriesWriter>> kymograms_;  ///< of each glottis
  std::unique_ptr<io::FieldsWriter> fields_;
  io::RecordLayout record_layout_;
  std::unique_ptr<io::RecordWriter> flow_record_;
  fem::Space parent_space_, flow_space_;  ///< P1, for the fields, as the next
  std::optional<transfer::SharedVertices> flow_to_parent_;
  std::vector<std::int32_t> vertex_is_wet_;  ///< of the flow mesh; for the fields and the record
};

}  // namespace vocalis::coupling
