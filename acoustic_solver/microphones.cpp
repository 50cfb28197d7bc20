#include "acoustic_solver/microphones.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

Microphones::Microphones(const mesh::Mesh& mesh, std::vector<MicrophoneSettings> settings, const FarFieldSettings& air)
    : mesh_(&mesh), settings_(std::move(settings)), locations_(settings_.size()), far_place_(settings_.size()) {
  add_far_fields(air);
  follow(mesh, true);
}

void Microphones::add_far_fields(const FarFieldSettings& air) {
  std::vector<std::vector<MicrophoneSettings>> groups;
  for (std::size_t m = 0; m < settings_.size(); ++m) {
    if (settings_[m].kind != MicrophoneKind::far_field) continue;
    const auto has_its_surface = [&](const std::vector<MicrophoneSettings>& group) {
      return group.front().surface == settings_[m].surface && group.front().mirrors == settings_[m].mirrors;
    };
    auto group = std::find_if(groups.begin(), groups.end(), has_its_surface);
    if (group == groups.end()) group = groups.emplace(groups.end());
    far_place_[m] = {static_cast<std::size_t>(group - groups.begin()), group->size()};
    group->push_back(settings_[m]);
  }
  for (const auto& group : groups) far_fields_.emplace_back(*mesh_, group, air);
}

std::vector<std::string> Microphones::outside() const {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < settings_.size(); ++m) {
    if (settings_[m].kind == MicrophoneKind::mesh && locations_[m].rank < 0) names.push_back(settings_[m].name);
  }
  return names;
}

void Microphones::require_inside() const {
  const auto names = outside();
  if (names.empty()) return;
  throw base::UserError("every microphone lies inside of the air", fmt::format("outside: {}", fmt::join(names, ", ")),
                        "move their positions [m] into the mesh of the air, or write kind = \"far_field\" with the "
                        "surface that their sound comes through");
}

std::vector<std::int32_t> Microphones::in_flow(std::span<const std::int32_t> cell_has_flow) const {
  std::vector<std::int32_t> result;
  for (const mesh::Location& location : locations_) {
    const bool is_here = location.rank == base::rank(mesh_->comm);
    const std::int32_t here = is_here && cell_has_flow[location.cell] != 0;
    result.push_back(base::largest(mesh_->comm, here));
  }
  return result;
}

void Microphones::sample(double time, std::span<const double> vertex_values, const FlowPressure* flow) {
  const int here = base::rank(mesh_->comm);
  for (FarField& far : far_fields_) far.sample(time, vertex_values);
  state_.times.push_back(time);
  for (std::size_t m = 0; m < settings_.size(); ++m) {
    const mesh::Location& location = locations_[m];
    const auto interpolated = [&](std::span<const double> values) {
      const auto vertices = mesh_->vertices_of(location.cell);
      double value = 0;
      for (int i = 0; i <= mesh_->dimension; ++i) value += location.barycentric[i] * values[vertices[i]];
      return value;
    };
    const bool is_far = settings_[m].kind == MicrophoneKind::far_field;
    const bool is_here = !is_far && location.rank == here;
    double value = 0;
    if (is_far) value = far_fields_[far_place_[m][0]].pressure(far_place_[m][1], time);
    if (is_here) value = interpolated(vertex_values);
    state_.values.push_back(value);
    if (!flow) continue;
    state_.flow.push_back(is_here && flow->cell_has_flow[location.cell] ? interpolated(flow->vertex_values) : 0);
  }
}

void Microphones::follow(const mesh::Mesh& mesh, bool is_other_mesh) {
  mesh_ = &mesh;
  const int here = base::rank(mesh.comm);
  constexpr double rounding = 1e-10;
  for (std::size_t m = 0; m < settings_.size(); ++m) {
    if (settings_[m].kind != MicrophoneKind::mesh) continue;
    mesh::Location& location = locations_[m];
    std::int32_t lost = is_other_mesh || location.rank < 0;
    if (!lost && location.rank == here) {
      location.barycentric = mesh::barycentric_coordinates(mesh, location.cell, settings_[m].position);
      const auto& weights = location.barycentric;
      lost = *std::min_element(weights.begin(), weights.begin() + mesh.dimension + 1) < -rounding;
    }
    if (base::largest(mesh.comm, lost) > 0) location = mesh::locate(mesh, settings_[m].position);
  }
}

void Microphones::adopt(const mesh::Mesh& mesh, std::span<const std::int32_t> vertex_there) {
  for (FarField& far : far_fields_) far.renumber(vertex_there);
  follow(mesh, true);
}

Microphones::Block Microphones::collect() {
  Block block;
  const bool root = base::rank(mesh_->comm) == 0;
  const auto sum_up = [&](const std::vector<double>& parts, std::vector<double>& whole) {
    if (root) whole.resize(parts.size());
    MPI_Reduce(parts.data(), whole.data(), static_cast<int>(parts.size()), MPI_DOUBLE, MPI_SUM, 0, mesh_->comm);
  };
  sum_up(state_.values, block.values);
  sum_up(state_.flow, block.flow);
  if (root) block.times = state_.times;
  state_ = {};
  return block;
}

}  // namespace vocalis::acoustic
