#include "acoustic_solver/integrator_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "acoustic_solver/wall_branches.hpp"

namespace vocalis::acoustic {

namespace {

constexpr double kMostSubSteps = 1e6;

/// What an implicit step costs, in explicit sub-steps of the same mesh, if `parts` of these make up the step. In the
/// plane it is a solution with factors that were found once; in space its iterations grow with the step, measured up to
/// 25 parts. tests/benchmarks/acoustic_integrators.cpp
double cost_of_implicit_step(int dimension, int parts) { return dimension == 2 ? 13 : std::min(8 + 1.8 * parts, 52.0); }

}  // namespace

std::string words(const IntegratorChoice& choice) {
  return (choice.integrator == Integrator::leap_frog ? "explicit: " : "implicit: ") + choice.reason;
}

int count_sub_steps(double dt, double longest) {
  const double count = std::ceil(dt / longest * (1 - 1e-9));
  return count < kMostSubSteps ? std::max(1, static_cast<int>(count)) : 0;
}

IntegratorChoice choose_integrator(const AcousticSettings& settings, int dimension, Convection convection, double dt,
                                   double stable_step) {
  if (settings.integrator != Integrator::automatic) return {settings.integrator, "as the case says"};
  if (settings.velocity_elements == VelocityElements::p1) return {Integrator::implicit, "velocities are in P1"};
  if (!settings.layers.empty()) return {Integrator::implicit, "it knows layers"};
  if (has_yielding_walls(settings)) return {Integrator::implicit, "it knows walls that yield"};
  // Loops over cells, several times for the terms with β, cost a multiple of sweeps over assembled rows.
  if (convection.mesh_moves) return {Integrator::implicit, "the mesh moves"};
  if (convection.medium_flows) return {Integrator::implicit, "the medium flows"};
  if (settings.spectral_radius < 1) return {Integrator::implicit, "spectral_radius is below 1"};
  const int steps = count_sub_steps(dt, settings.step);
  const int parts = count_sub_steps(dt / steps, kPartOfStableStep * stable_step);
  if (parts == 0) return {Integrator::implicit, "a cell has closed"};
  const double cost = cost_of_implicit_step(dimension, parts);
  const bool is_explicit = parts <= cost;
  return {is_explicit ? Integrator::leap_frog : Integrator::implicit,
          fmt::format("{} explicit sub-steps of {:.2g} s cost {:.2g} of an implicit step of {:.2g} s", parts,
                      dt / steps / parts, parts / cost, dt / steps)};
}

}  // namespace vocalis::acoustic
