#pragma once

#include "core/io/record_reader.hpp"
#include "coupling/flow/given_flow.hpp"

namespace vocalis::coupling {

/// A flow that was recorded, here or by others. It takes the steps that it was recorded in; its first one is time 0.
class RecordedFlow : public GivenFlow {
 public:
  /// Collective. Throws UserError for a record that cannot be read, or is of another mesh.
  RecordedFlow(const std::string& file, const Scene& scene);

  double end() const override { return record_.times().back(); }
  double dt(const Clock& clock) const override;
  FlowSnapshot snapshot(long steps, double time) const override;
  bool can_close() const override { return record_.has_marks(); }

 private:
  const mesh::Mesh& mesh_;
  io::RecordReader record_;
};

/// What a record keeps of a flow: velocities of edges where they are known, displacement where its mesh moves, contact
/// where it can close.
struct RecordedParts {
  bool edges = false, displacement = false, contact = false;
};
io::RecordLayout layout_of_flow(int dimension, const RecordedParts& parts, bool single);
/// A snapshot as that layout has it. What vertices without fluid have is no part of the sound, and left at 0.
io::RecordStep recorded(const io::RecordLayout& layout, const FlowSnapshot& snapshot, const mesh::Mesh& mesh,
                        const std::vector<std::int32_t>& vertex_is_wet);

}  // namespace vocalis::coupling
