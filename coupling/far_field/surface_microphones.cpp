#include "coupling/far_field/surface_microphones.hpp"

#include "core/base/mpi.hpp"

namespace vocalis::coupling {

SurfaceMicrophones::SurfaceMicrophones(const Scene& scene, const Case& config) : comm_(scene.parent.comm) {
  if (config.surface_microphones.empty()) return;
  const mesh::Mesh& mesh = scene.flow->mesh;
  std::vector<std::int32_t> cell_is_fluid;
  for (const std::int32_t region : mesh.cell_region) {
    cell_is_fluid.push_back(scene.kind_of_region[region] == RegionKind::fluid);
  }
  const FlowMaterial material = {config.fluid.density, config.fluid.viscosity};
  for (const SurfaceMicrophoneSettings& settings : config.surface_microphones) {
    microphones_.emplace_back(mesh, cell_is_fluid, material, settings, SoundClock{config.time.step, config.time.end});
  }
}

void SurfaceMicrophones::follow(const FlowSnapshot& before, const FlowSnapshot& flow) {
  if (microphones_.empty()) return;
  times_.push_back(flow.time);
  for (SurfaceMicrophone& microphone : microphones_) values_.push_back(microphone.follow(before, flow));
}

SurfaceMicrophones::Block SurfaceMicrophones::collect() {
  Block block;
  const bool is_first = base::rank(comm_) == 0;
  if (is_first) block.values.resize(values_.size());
  MPI_Reduce(values_.data(), block.values.data(), static_cast<int>(values_.size()), MPI_DOUBLE, MPI_SUM, 0, comm_);
  if (is_first) block.times = times_;
  times_.clear();
  values_.clear();
  return block;
}

}  // namespace vocalis::coupling
