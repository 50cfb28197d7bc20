#include "coupling/flow/solved_flow.hpp"

namespace vocalis::coupling {

SolvedFlow::SolvedFlow(const Scene& scene, const fsi::FsiSolver& flow)
    : flow_(flow), vertex_to_pressure_(scene.flow->mesh.num_vertices(), -1) {
  const std::vector<std::int32_t> is_fluid = fluid_cells(scene);
  for (std::int32_t cell = 0; cell < scene.flow->mesh.num_cells(); ++cell) {
    if (!is_fluid[cell]) continue;
    const auto dofs = flow.pressure_space().dofs_of(cell);
    const auto vertices = scene.flow->mesh.vertices_of(cell);
    for (std::size_t i = 0; i < vertices.size(); ++i) vertex_to_pressure_[vertices[i]] = dofs[i];
  }
  if (flow.velocity_space().degree == 1) return;
  const mesh::Mesh& mesh = scene.flow->mesh;
  const int edges = static_cast<int>(mesh::edges_of_cell(mesh.dimension).size()), corners = mesh.dimension + 1;
  edge_to_velocity_.assign(mesh.edges.num_local(), -1);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = flow.velocity_space().dofs_of(cell);
    for (int e = 0; e < edges; ++e) edge_to_velocity_[mesh.cell_edges[cell * edges + e]] = dofs[corners + e];
  }
}

std::vector<double> SolvedFlow::velocity_of_edges() const {
  const fem::Field& velocity = flow_.state().velocity;
  std::vector<double> result;
  for (const std::int32_t dof : edge_to_velocity_) {
    for (int k = 0; k < velocity.components; ++k) result.push_back(dof < 0 ? 0 : velocity.at(dof)[k]);
  }
  return result;
}

FlowSnapshot SolvedFlow::snapshot() const {
  const fsi::State& state = flow_.state();
  FlowSnapshot result;
  result.time = state.time;
  result.pressure.assign(vertex_to_pressure_.size(), 0.0);
  for (std::size_t vertex = 0; vertex < result.pressure.size(); ++vertex) {
    if (vertex_to_pressure_[vertex] >= 0) result.pressure[vertex] = state.pressure.values[vertex_to_pressure_[vertex]];
  }
  result.velocity = flow_.velocity_at_vertices().values;
  result.velocity_of_edges = velocity_of_edges();
  result.displacement = flow_.displacement_at_vertices().values;
  result.in_contact = state.in_contact;
  return result;
}

}  // namespace vocalis::coupling
