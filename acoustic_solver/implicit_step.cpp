#include "acoustic_solver/implicit_step.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

constexpr std::size_t kEarlierPressures = 3;
constexpr int kLargestPasses = 30;
// A pass leaves an error |β| dt / h times as large as it finds: a change so much above the solver's tolerance is
// enough.
constexpr double kPassTolerance = 100;

/// The increment of p expected from the increments of the sub-steps before: the polynomial through them.
std::vector<double> extrapolated_increment(const State& state) {
  std::vector<double> guess(state.p.size(), 0.0);
  const auto& earlier = state.earlier;
  const auto add = [&guess](double factor, const std::vector<double>& values) {
    for (std::size_t i = 0; i < guess.size(); ++i) guess[i] += factor * values[i];
  };
  if (earlier.size() == 1) {
    add(1, state.p), add(-1, earlier[0]);
  } else if (earlier.size() == 2) {
    add(2, state.p), add(-3, earlier[0]), add(1, earlier[1]);
  } else if (earlier.size() >= 3) {
    add(3, state.p), add(-6, earlier[0]), add(4, earlier[1]), add(-1, earlier[2]);
  }
  return guess;
}

}  // namespace

ImplicitStep::ImplicitStep(const mesh::Mesh& mesh, const fem::Space& space, const WaveOperator& wave,
                           const Layers& layers, const YieldingWalls& walls, const AcousticSettings& settings)
    : mesh_(&mesh),
      space_(&space),
      wave_(&wave),
      layers_(&layers),
      walls_(&walls),
      density_(settings.density),
      theta_(settings.theta),
      tolerance_(settings.solver_tolerance),
      system_(mesh, space, wave.released(), settings) {}

double ImplicitStep::norm(const std::vector<double>& owned_values) const {
  double square = 0;
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) square += owned_values[i] * owned_values[i];
  return std::sqrt(base::sum(mesh_->comm, square));
}

bool ImplicitStep::advance(const SubStep& step, State& state, AdvanceReport& report) {
  // Unknown: δ = p_θ - p at the θ-point, where ψ_θ = ψ + θ dt (p_θ / ρ + β·∇ψ_θ). With it the mass of p drops out:
  //   (mass / (θ dt) + admittance + b stiffness) δ = load - admittance p - stiffness (ψ + b p) + terms with β.
  const double a = 1 / (theta_ * step.dt), b = theta_ * step.dt / density_;
  if (step.moves || !system_.is_assembled(a, b)) system_.assemble(*wave_, *layers_, a, b);
  const std::size_t num_vertices = state.p.size();
  std::vector<double> fixed(num_vertices, 0.0), potential(num_vertices);
  for (std::size_t v = 0; v < num_vertices; ++v) potential[v] = state.psi[v] + b * state.p[v];
  wave_->add_flux(step.flux, fixed);
  wave_->add_admittance(-1, state.p, fixed);
  wave_->add_stiffness(-1, potential, fixed);
  layers_->add_forces(theta_ * step.dt, state.p, potential, state, fixed);
  walls_->add_forces(theta_ * step.dt, state.p, state, fixed);
  space_->halo.add_to_owners(fixed);
  for (std::size_t v = 0; v < step.load.size(); ++v) fixed[v] += step.load[v];

  std::vector<double> increment = extrapolated_increment(state);
  for (double& value : increment) value *= theta_;
  std::vector<double> right_hand_side = fixed, convection(num_vertices, 0.0), difference, middle_pressure, scaled;
  const auto update_convection = [&] {
    middle_pressure = state.p;
    for (std::size_t v = 0; v < num_vertices; ++v) {
      middle_pressure[v] += increment[v];
      potential[v] = state.psi[v] + b * middle_pressure[v] + theta_ * step.dt * convection[v];
    }
    const auto wall_velocities = walls_->velocities(theta_ * step.dt, middle_pressure, state);
    wave_->potential_convection(potential, middle_pressure, convection, wall_velocities);
  };
  if (step.moves) update_convection();
  for (int pass = 0;; ++pass) {
    if (step.moves) {
      scaled = convection;
      for (double& value : scaled) value *= theta_ * step.dt;
      std::vector<double> terms(num_vertices, 0.0);
      wave_->add_convection(middle_pressure, terms);
      wave_->add_stiffness(-1, scaled, terms);
      space_->halo.add_to_owners(terms);
      difference = right_hand_side;
      for (std::size_t v = 0; v < num_vertices; ++v) right_hand_side[v] = fixed[v] + terms[v];
      for (std::size_t v = 0; v < num_vertices; ++v) difference[v] -= right_hand_side[v];
      for (const std::int32_t v : wave_->released()) difference[v] = 0;
      const double tolerance = kPassTolerance * tolerance_;
      if (pass > 0 && norm(difference) <= tolerance * norm(right_hand_side)) break;
      if (pass == kLargestPasses) {
        report.converged = false;
        report.reason = fmt::format("the terms of the mesh's motion did not converge in {} passes", kLargestPasses);
        return false;
      }
    }
    const la::SolveReport solved = system_.solve(right_hand_side, increment);
    report.linear_iterations += solved.iterations;
    ++report.passes;
    if (!solved.converged) {
      report.converged = false;
      report.reason = "pressure system: " + solved.reason;
      return false;
    }
    space_->halo.copy_to_ghosts(increment);
    if (!step.moves) break;
    update_convection();
  }

  if (layers_->exist() || walls_->exist()) {
    middle_pressure = state.p;
    for (std::size_t v = 0; v < num_vertices; ++v) {
      middle_pressure[v] += increment[v];
      potential[v] = state.psi[v] + b * middle_pressure[v] + theta_ * step.dt * convection[v];
    }
    layers_->advance(step.dt, theta_, middle_pressure, potential, state);
    walls_->advance(step.dt, theta_, middle_pressure, state);
  }
  auto& earlier = state.earlier;
  if (earlier.size() == kEarlierPressures) earlier.pop_back();
  earlier.insert(earlier.begin(), state.p);
  for (std::size_t v = 0; v < num_vertices; ++v) {
    state.psi[v] += step.dt * ((state.p[v] + increment[v]) / density_ + convection[v]);
    state.p[v] += increment[v] / theta_;
  }
  return true;
}

}  // namespace vocalis::acoustic
