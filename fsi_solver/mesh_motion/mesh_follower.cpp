#include "fsi_solver/mesh_motion/mesh_follower.hpp"

#include <algorithm>

namespace vocalis::fsi {

MeshFollower::MeshFollower(const Continuum& continuum, const Conditions& conditions, const FlowSettings& settings,
                           base::Timers& timers)
    : continuum_(continuum),
      timers_(timers),
      conditions_(conditions),
      settings_(settings),
      start_(continuum.vertex_space, continuum.mesh->dimension) {
  rebuild();
}

void MeshFollower::rebuild() {
  linear_.emplace(continuum_, conditions_, settings_.mesh_stiffening);
  if (settings_.smoother == Smoother::nonlinear) {
    nonlinear_ = std::make_unique<NonlinearSmoother>(continuum_, conditions_, settings_.mesh_stiffening);
  }
}

void MeshFollower::begin_step(const fem::Field& displacement, std::span<const double> offset) {
  if (!nonlinear_) return;
  start_.values = displacement.values;
  for (std::size_t i = 0; i < offset.size(); ++i) start_.values[i] -= offset[i];
  if (!(smallest_fluid_quality(continuum_, start_) > 0)) start_.values = displacement.values;
}

void MeshFollower::drop_factors() {
  if (nonlinear_) nonlinear_->drop_factors();
}

void MeshFollower::extend(fem::Field& displacement) {
  const auto scope = timers_.scope("mesh_motion");
  linear_->extend(displacement);
  if (!nonlinear_) return;
  const double bad =
      std::clamp(2 * (1 - smallest_fluid_quality(continuum_, displacement) / settings_.smoother_quality), 0.0, 1.0);
  if (bad > 0) {
    fem::Field other = displacement;
    if (nonlinear_->extend(other, start_).converged) {
      const double part = bad * bad * (3 - 2 * bad);
      for (std::size_t i = 0; i < displacement.values.size(); ++i) {
        displacement.values[i] += part * (other.values[i] - displacement.values[i]);
      }
    }
  }
  if (smallest_fluid_quality(continuum_, displacement) > 0) start_.values = displacement.values;
}

}  // namespace vocalis::fsi
