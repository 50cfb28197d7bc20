#include "coupling/flow/recorded_flow.hpp"

#include <algorithm>

namespace vocalis::coupling {

RecordedFlow::RecordedFlow(const std::string& file, const Scene& scene)
    : mesh_(scene.flow->mesh),
      record_(file, mesh_, {{"pressure", 1}, {"velocity", mesh_.dimension}}, {{"displacement", mesh_.dimension}}) {}

double RecordedFlow::dt(const Clock& clock) const {
  const std::size_t next = std::min(static_cast<std::size_t>(clock.step) + 1, record_.times().size() - 1);
  return record_.times()[next] - record_.times()[next - 1];
}

FlowSnapshot RecordedFlow::snapshot(long steps, double) const {
  FlowSnapshot result;
  result.time = record_.times()[steps];
  result.pressure = record_.read("pressure", steps);
  result.velocity = record_.read("velocity", steps);
  if (record_.has("displacement")) {
    result.displacement = record_.read("displacement", steps);
  } else {
    result.displacement.assign(result.velocity.size(), 0.0);
  }
  if (record_.has_marks()) result.in_contact = record_.read_marks(steps);
  return result;
}

io::RecordLayout layout_of_flow(int dimension, bool moves, bool can_close, bool single) {
  io::RecordLayout layout{
      .fields = {{"pressure", 1}, {"velocity", dimension}}, .has_marks = can_close, .single = single};
  if (moves) layout.fields.push_back({"displacement", dimension});
  return layout;
}

io::RecordStep recorded(const io::RecordLayout& layout, const FlowSnapshot& snapshot,
                        const std::vector<std::int32_t>& vertex_is_wet) {
  io::RecordStep step{.time = snapshot.time, .fields = {snapshot.pressure, snapshot.velocity}, .marks = {}};
  if (layout.fields.size() > 2) step.fields.push_back(snapshot.displacement);
  for (std::size_t i = 0; i < step.fields.size(); ++i) {
    const int width = layout.fields[i].components;
    for (std::size_t v = 0; v < vertex_is_wet.size(); ++v) {
      if (!vertex_is_wet[v]) std::fill_n(step.fields[i].begin() + v * width, width, 0.0);
    }
  }
  if (layout.has_marks) step.marks = snapshot.in_contact;
  return step;
}

}  // namespace vocalis::coupling
