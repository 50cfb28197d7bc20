#include "acoustic_solver/microphones.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

Microphones::Microphones(const mesh::Mesh& mesh, std::vector<MicrophoneSettings> settings)
    : mesh_(&mesh), settings_(std::move(settings)), locations_(settings_.size()) {
  follow(mesh, true);
}

std::vector<std::string> Microphones::outside() const {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < settings_.size(); ++m) {
    if (locations_[m].rank < 0) names.push_back(settings_[m].name);
  }
  return names;
}

void Microphones::require_inside() const {
  const auto names = outside();
  if (names.empty()) return;
  throw base::UserError("every microphone lies inside of the air", fmt::format("outside: {}", fmt::join(names, ", ")),
                        "move their positions [m] into the mesh of the air");
}

void Microphones::sample(double time, std::span<const double> vertex_values) {
  const int here = base::rank(mesh_->comm);
  state_.times.push_back(time);
  for (const mesh::Location& location : locations_) {
    double value = 0;
    if (location.rank == here) {
      const auto vertices = mesh_->vertices_of(location.cell);
      for (int i = 0; i <= mesh_->dimension; ++i) value += location.barycentric[i] * vertex_values[vertices[i]];
    }
    state_.values.push_back(value);
  }
}

void Microphones::follow(const mesh::Mesh& mesh, bool is_other_mesh) {
  mesh_ = &mesh;
  const int here = base::rank(mesh.comm);
  constexpr double rounding = 1e-10;
  for (std::size_t m = 0; m < settings_.size(); ++m) {
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

Microphones::Block Microphones::collect() {
  Block block;
  const bool root = base::rank(mesh_->comm) == 0;
  if (root) block.values.resize(state_.values.size());
  MPI_Reduce(state_.values.data(), block.values.data(), static_cast<int>(state_.values.size()), MPI_DOUBLE, MPI_SUM, 0,
             mesh_->comm);
  if (root) block.times = state_.times;
  state_ = {};
  return block;
}

}  // namespace vocalis::acoustic
