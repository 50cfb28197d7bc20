#include "coupling/flow_history.hpp"

#include "core/mesh/facets.hpp"

namespace vocalis::coupling {

FlowHistory::FlowHistory(const Scene& scene, const fsi::FsiSolver& flow)
    : scene_(scene),
      flow_(flow),
      space_(fem::lagrange(scene.flow->mesh, 1)),
      cell_is_fluid_(fluid_cells(scene)),
      outlet_(flow_outlet(scene)),
      vertex_to_pressure_(scene.flow->mesh.num_vertices(), -1) {
  const fem::Space& pressures = flow.pressure_space();
  for (std::int32_t cell = 0; cell < scene.flow->mesh.num_cells(); ++cell) {
    if (!cell_is_fluid_[cell]) continue;
    const auto dofs = pressures.dofs_of(cell);
    const auto vertices = scene.flow->mesh.vertices_of(cell);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertex_to_pressure_[vertices[i]] = dofs[i];
  }
  cell_emits_ = cell_is_fluid_;
  begin_step();
}

std::vector<double> FlowHistory::vertex_pressure() const {
  std::vector<double> result(vertex_to_pressure_.size(), 0.0);
  for (std::size_t vertex = 0; vertex < result.size(); ++vertex) {
    if (vertex_to_pressure_[vertex] >= 0) result[vertex] = flow_.state().pressure.values[vertex_to_pressure_[vertex]];
  }
  return result;
}

fem::Field FlowHistory::displacement_end() const {
  fem::Field result = flow_.displacement_at_vertices();
  result.space = &space_;
  return result;
}

void FlowHistory::begin_step() {
  time_begin_ = flow_.state().time;
  pressure_begin_ = vertex_pressure();
  velocity_begin_ = flow_.velocity_at_vertices().values;
  displacement_begin_ = displacement_end();
  if (flow_.settings().contact) leave_out_contact();
}

void FlowHistory::leave_out_contact() {
  std::vector<std::int32_t> is_contact(cell_is_fluid_.size(), 0);
  for (const std::span<const char> marks :
       {std::span<const char>(contact_before_), std::span<const char>(flow_.state().in_contact)}) {
    for (std::size_t cell = 0; cell < marks.size(); ++cell) is_contact[cell] |= marks[cell] != 0;
  }
  cell_emits_ = cell_is_fluid_;
  for (std::size_t cell = 0; cell < is_contact.size(); ++cell) {
    if (is_contact[cell]) cell_emits_[cell] = 0;
  }
  vertex_is_silent_ = mesh::mark_vertices_of_cells(scene_.flow->mesh, is_contact);
}

FlowView FlowHistory::view() const {
  const mesh::Mesh& mesh = scene_.flow->mesh;
  FlowView view;
  view.space = &space_;
  view.time_begin = time_begin_;
  view.time_end = flow_.state().time;
  view.cell_is_fluid = cell_emits_;
  view.vertex_is_silent = vertex_is_silent_;
  view.outlet = outlet_;
  view.pressure_begin = pressure_begin_;
  view.pressure_end = vertex_pressure();
  view.velocity_begin = velocity_begin_;
  view.velocity_end = flow_.velocity_at_vertices().values;
  const fem::Field end = displacement_end();
  const double dt = view.time_end - view.time_begin;
  view.coordinates_middle = mesh.coordinates;
  view.mesh_velocity.resize(mesh.coordinates.size());
  for (std::size_t i = 0; i < mesh.coordinates.size(); ++i) {
    view.coordinates_middle[i] += 0.5 * (displacement_begin_.values[i] + end.values[i]);
    view.mesh_velocity[i] = (end.values[i] - displacement_begin_.values[i]) / dt;
  }
  return view;
}

}  // namespace vocalis::coupling
