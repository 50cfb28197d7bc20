#include "coupling/flow/recorded_flow.hpp"

#include <algorithm>

namespace vocalis::coupling {

namespace {

using Field = io::RecordLayout::Field;

Field pressure() { return {"pressure", 1}; }
Field velocity(int dimension) { return {"velocity", dimension}; }
Field velocity_of_edges(int dimension) { return {"velocity_of_edges", dimension, io::Place::edges}; }
Field displacement(int dimension) { return {"displacement", dimension}; }

const std::vector<double>& values_of(const std::string& field, const FlowSnapshot& snapshot) {
  if (field == "pressure") return snapshot.pressure;
  if (field == "velocity") return snapshot.velocity;
  if (field == "velocity_of_edges") return snapshot.velocity_of_edges;
  return snapshot.displacement;
}

}  // namespace

RecordedFlow::RecordedFlow(const std::string& file, const Scene& scene)
    : mesh_(scene.flow->mesh),
      record_(file, mesh_, {pressure(), velocity(mesh_.dimension)},
              {velocity_of_edges(mesh_.dimension), displacement(mesh_.dimension)}) {}

double RecordedFlow::dt(const Clock& clock) const {
  const std::size_t next = std::min(static_cast<std::size_t>(clock.step) + 1, record_.times().size() - 1);
  return record_.times()[next] - record_.times()[next - 1];
}

FlowSnapshot RecordedFlow::snapshot(long steps, double) const {
  FlowSnapshot result;
  result.time = record_.times()[steps];
  result.pressure = record_.read("pressure", steps);
  result.velocity = record_.read("velocity", steps);
  if (record_.has("velocity_of_edges")) result.velocity_of_edges = record_.read("velocity_of_edges", steps);
  if (record_.has("displacement")) {
    result.displacement = record_.read("displacement", steps);
  } else {
    result.displacement.assign(result.velocity.size(), 0.0);
  }
  if (record_.has_marks()) result.in_contact = record_.read_marks(steps);
  return result;
}

io::RecordLayout layout_of_flow(int dimension, const RecordedParts& parts, bool single) {
  io::RecordLayout layout{.fields = {pressure(), velocity(dimension)}, .has_marks = parts.contact, .single = single};
  if (parts.edges) layout.fields.push_back(velocity_of_edges(dimension));
  if (parts.displacement) layout.fields.push_back(displacement(dimension));
  return layout;
}

io::RecordStep recorded(const io::RecordLayout& layout, const FlowSnapshot& snapshot, const mesh::Mesh& mesh,
                        const std::vector<std::int32_t>& vertex_is_wet) {
  io::RecordStep step{.time = snapshot.time, .fields = {}, .marks = {}};
  if (layout.has_marks) step.marks = snapshot.in_contact;
  for (const Field& field : layout.fields) {
    std::vector<double>& values = step.fields.emplace_back(values_of(field.name, snapshot));
    const auto is_wet = [&](std::size_t row) {
      if (field.where == io::Place::vertices) return vertex_is_wet[row] != 0;
      return vertex_is_wet[mesh.edge_vertices[2 * row]] && vertex_is_wet[mesh.edge_vertices[2 * row + 1]];
    };
    for (std::size_t row = 0; row * field.components < values.size(); ++row) {
      if (!is_wet(row)) std::fill_n(values.begin() + row * field.components, field.components, 0.0);
    }
  }
  return step;
}

}  // namespace vocalis::coupling
