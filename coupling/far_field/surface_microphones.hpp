#pragma once

#include <vector>

#include "coupling/case/case.hpp"
#include "coupling/far_field/surface_microphone.hpp"
#include "coupling/scene.hpp"

namespace vocalis::coupling {

/// All microphones of a case that hear surfaces of its flow. Each rank has the part of its facets; samples, one a step
/// of the flow, stay on the ranks and meet on rank 0 in blocks.
class SurfaceMicrophones {
 public:
  /// Samples of all microphones, on rank 0.
  struct Block {
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< (samples, microphones) [Pa]
  };

  /// The scene must outlive it. Throws UserError for a microphone that cannot be, see `SurfaceMicrophone`. Collective.
  SurfaceMicrophones(const Scene& scene, const Case& config);

  /// Listens to one accepted step of the flow, from one snapshot to the next. Not collective.
  void follow(const FlowSnapshot& before, const FlowSnapshot& flow);

  /// The samples since the last time, on rank 0; on the others empty. Collective.
  Block collect();

  std::vector<SurfaceMicrophone>& microphones() { return microphones_; }
  const std::vector<SurfaceMicrophone>& microphones() const { return microphones_; }

 private:
  MPI_Comm comm_;
  std::vector<SurfaceMicrophone> microphones_;
  std::vector<double> times_, values_;  ///< of `Block`, this rank's part
};

}  // namespace vocalis::coupling
