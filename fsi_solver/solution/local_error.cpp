#include "fsi_solver/solution/local_error.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"

namespace vocalis::fsi {

std::array<double, 2> speeds(const Continuum& continuum, const fem::Field& velocity) {
  std::array<double, 4> sums = {0, 0, 0, 0};  // squares, then numbers
  for (std::int32_t dof = 0; dof < velocity.space->dofs.num_owned; ++dof) {
    const int kind = continuum.dof_solid[dof] >= 0;
    for (int k = 0; k < velocity.components; ++k) sums[kind] += velocity.at(dof)[k] * velocity.at(dof)[k];
    sums[2 + kind] += 1;
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 4, MPI_DOUBLE, MPI_SUM, continuum.mesh->comm);
  return {std::sqrt(sums[0] / std::max(sums[2], 1.0)), std::sqrt(sums[1] / std::max(sums[3], 1.0))};
}

double local_error(const Continuum& continuum, const TimeSettings& settings, const Stage& stage, const State& state,
                   const fem::Field& end_velocity) {
  const bool is_euler = settings.scheme == TimeScheme::theta;
  if ((is_euler && settings.theta < 1) || state.last_dt <= 0) return 0;
  const double dt = stage.dt, last = state.last_dt, r = dt / last;
  const double constant = 1 / (6 * (2 * dt + last)) * (dt + last) * (dt + last) * dt;
  const double ratio = is_euler ? 0.5 : constant / (constant + dt * dt * (dt + last) / 6);
  fem::Field error = end_velocity;
  for (std::size_t i = 0; i < error.values.size(); ++i) {
    const double now = state.velocity.values[i], before = state.velocity_before.values[i];
    const double rate = state.acceleration.values[i];
    const double predicted = is_euler ? now + dt * rate : now + (1 + r) * dt * rate - r * r * (now - before);
    error.values[i] = ratio * (end_velocity.values[i] - predicted);
  }
  const std::array<double, 2> errors = speeds(continuum, error), sizes = speeds(continuum, end_velocity);
  double result = 0;
  for (int kind = 0; kind < 2; ++kind) {
    const double size = std::max(sizes[kind], state.largest_speeds[kind]);
    if (size > 0) result = std::max(result, errors[kind] / size);
  }
  return result;
}

}  // namespace vocalis::fsi
