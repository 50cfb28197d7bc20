#include "coupling/flow/flow_history.hpp"

#include <algorithm>
#include <cassert>

#include "core/mesh/facets.hpp"

namespace vocalis::coupling {

FlowHistory::FlowHistory(const Scene& scene, int depth, bool can_close)
    : scene_(scene),
      depth_(depth),
      can_close_(can_close),
      space_(fem::lagrange(scene.flow->mesh, 1)),
      cell_is_fluid_(fluid_cells(scene)),
      outlet_(flow_outlet(scene)),
      walls_(flow_walls(scene)) {}

void FlowHistory::restart(FlowSnapshot snapshot) {
  snapshots_.clear();
  snapshots_.push_back(std::move(snapshot));
}

void FlowHistory::add(FlowSnapshot snapshot) {
  if (snapshots_.size() == depth_) snapshots_.pop_front();
  snapshots_.push_back(std::move(snapshot));
}

fem::Field FlowHistory::displacement(const FlowSnapshot& snapshot) const {
  fem::Field result(space_, scene_.flow->mesh.dimension);
  result.values = snapshot.displacement;
  return result;
}

bool FlowHistory::has_step(PressureDerivative derivative) const {
  return static_cast<int>(snapshots_.size()) >= 2 + lag_of(derivative);
}

const FlowSnapshot& FlowHistory::followed(PressureDerivative derivative) const {
  const int last = static_cast<int>(snapshots_.size()) - 1;
  return snapshots_[std::max(last - lag_of(derivative), 0)];
}

FlowStep FlowHistory::step(PressureDerivative derivative) const {
  assert(has_step(derivative));
  const std::size_t last = snapshots_.size() - 1 - lag_of(derivative);
  const FlowSnapshot &begin = snapshots_[last - 1], &end = snapshots_[last];
  FlowStep result;
  result.displacement_begin = displacement(begin);
  result.displacement_end = displacement(end);
  result.in_contact = end.in_contact;
  FlowView& view = result.view;
  view.space = &space_;
  view.time_begin = begin.time;
  view.time_end = end.time;
  view.cell_is_fluid = cell_is_fluid_;
  view.outlet = outlet_;
  view.walls = walls_;
  view.pressure_begin = begin.pressure;
  view.pressure_end = end.pressure;
  view.velocity_begin = begin.velocity;
  view.velocity_end = end.velocity;
  view.edges_begin = begin.velocity_of_edges;
  view.edges_end = end.velocity_of_edges;
  const double dt = view.time_end - view.time_begin;
  view.coordinates_middle = scene_.flow->mesh.coordinates;
  view.mesh_velocity.resize(view.coordinates_middle.size());
  for (std::size_t i = 0; i < view.mesh_velocity.size(); ++i) {
    view.coordinates_middle[i] += 0.5 * (begin.displacement[i] + end.displacement[i]);
    view.mesh_velocity[i] = (end.displacement[i] - begin.displacement[i]) / dt;
  }
  std::size_t first = last - 1;
  if (derivative != PressureDerivative::step) {
    constexpr std::size_t reach = 2;
    first -= std::min(first, reach);
    view.pressure_rate_begin = pressure_rate(snapshots_, static_cast<int>(last - 1), derivative);
    view.pressure_rate_end = pressure_rate(snapshots_, static_cast<int>(last), derivative);
  }
  if (can_close_) leave_out_contact(view, first);
  return result;
}

void FlowHistory::leave_out_contact(FlowView& view, std::size_t first) const {
  std::vector<std::int32_t> is_contact(cell_is_fluid_.size(), 0);
  for (std::size_t n = first; n < snapshots_.size(); ++n) {
    const std::vector<char>& marks = snapshots_[n].in_contact;
    for (std::size_t cell = 0; cell < marks.size(); ++cell) is_contact[cell] |= marks[cell] != 0;
  }
  for (std::size_t cell = 0; cell < is_contact.size(); ++cell) {
    if (is_contact[cell]) view.cell_is_fluid[cell] = 0;
  }
  view.vertex_is_silent = mesh::mark_vertices_of_cells(scene_.flow->mesh, is_contact);
}

}  // namespace vocalis::coupling
