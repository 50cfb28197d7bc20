#include "acoustic_solver/implicit_step.hpp"

#include <fmt/format.h>

#include <utility>

#include "acoustic_solver/relative_change.hpp"

namespace vocalis::acoustic {

namespace {

constexpr std::size_t kEarlierPressures = 3;
constexpr int kLargestPasses = 30;
// A pass leaves a small part of the error that it finds: a change so much above the solver's tolerance is enough, of
// the right-hand side, or of what carries ψ. The latter saves making the terms once more; where sound crosses many
// cells in a step the solver's own error is too large for it.
constexpr double kPassTolerance = 100, kSettled = 10;

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
      settings_(settings),
      density_(settings.density),
      tolerance_(settings.solver_tolerance),
      scheme_(settings.spectral_radius),
      start_(GeneralisedAlpha::start()),
      keeps_rates_(settings.spectral_radius < 1) {}

bool ImplicitStep::is_small(const std::vector<double>& difference, const std::vector<double>& values,
                            double part) const {
  double change = 0, size = 0;
  for (std::int32_t i = 0; i < space_->dofs.num_owned; ++i) {
    change += difference[i] * difference[i];
    size += values[i] * values[i];
  }
  return is_small_change(mesh_->comm, change, size, part);
}

PressureSystem& ImplicitStep::system_for(const SubStep& step, double beta) {
  const double a = 1 / beta, b = beta / density_;
  while (static_cast<int>(systems_.size()) <= step.slot) {
    systems_.push_back(std::make_unique<PressureSystem>(*mesh_, *space_, wave_->released(), settings_));
  }
  PressureSystem& system = *systems_[step.slot];
  const bool is_assembled = step.moves ? system.is_assembled(a, b, step.begin) : system.is_assembled(a, b);
  if (!is_assembled) system.assemble(*wave_, *layers_, a, b, step.begin, step.is_shared);
  return system;
}

bool ImplicitStep::solve_step(const SubStep& step, PressureSystem& system, const std::vector<double>& fixed,
                              ImplicitConvection& convection, std::vector<double>& increment, AdvanceReport& report) {
  std::vector<double> right_hand_side, difference;
  if (step.convects) convection.update(increment);
  for (int pass = 0;; ++pass) {
    difference = std::exchange(right_hand_side, fixed);
    if (step.convects) convection.add_terms(right_hand_side);
    if (pass > 0) {
      for (std::size_t v = 0; v < difference.size(); ++v) difference[v] -= right_hand_side[v];
      for (const std::int32_t v : wave_->released()) difference[v] = 0;
      if (is_small(difference, right_hand_side, kPassTolerance * tolerance_)) return true;
    }
    if (pass == kLargestPasses) {
      report.converged = false;
      report.reason = fmt::format("the terms of motion and flow did not converge in {} passes", kLargestPasses);
      return false;
    }
    const la::SolveReport solved = system.solve(right_hand_side, increment);
    report.linear_iterations += solved.iterations;
    ++report.passes;
    if (!solved.converged) {
      report.converged = false;
      report.reason = "pressure system: " + solved.reason;
      return false;
    }
    space_->halo.copy_to_ghosts(increment);
    if (!step.convects) return true;
    convection.update(increment);
    if (convection.has_settled(kSettled * tolerance_)) return true;
  }
}

bool ImplicitStep::advance(const SubStep& step, State& state, AdvanceReport& report) {
  // Unknown: δ = p_θ - p* at the stage, where ψ_θ = ψ* + θ dt (p_θ / ρ + v·∇ψ_θ). With it the mass of p* drops out:
  //   (mass / (θ dt) + admittance + b stiffness) δ = load - admittance p* - stiffness (ψ* + b p*) + terms with v.
  const GeneralisedAlpha& alpha = scheme(state);
  const double beta = alpha.part() * step.dt, b = beta / density_;
  PressureSystem& system = system_for(step, beta);
  const std::size_t num_vertices = state.p.size();
  Unknowns stage = alpha.shifted(state, step.dt);
  ImplicitConvection convection(*space_, *wave_, *walls_, density_, beta, stage);
  std::vector<double> increment = extrapolated_increment(state);
  for (std::size_t v = 0; v < num_vertices; ++v) increment[v] = alpha.at() * increment[v] + state.p[v] - stage.p[v];
  for (const std::int32_t v : wave_->inlets()) increment[v] = 0;

  const std::vector<double>& pressure = convection.base();
  std::vector<double> fixed(num_vertices, 0.0), potential(num_vertices);
  for (std::size_t v = 0; v < num_vertices; ++v) potential[v] = stage.psi[v] + b * pressure[v];
  wave_->add_flux(step.flux, fixed);
  wave_->add_admittance(-1, pressure, fixed);
  wave_->add_stiffness(-1, potential, fixed);
  layers_->add_forces(beta, pressure, potential, stage, fixed);
  walls_->add_forces(beta, pressure, stage, fixed);
  space_->halo.add_to_owners(fixed);
  for (std::size_t v = 0; v < step.load.size(); ++v) fixed[v] += step.load[v];
  if (!solve_step(step, system, fixed, convection, increment, report)) return false;

  if (layers_->exist() || walls_->exist()) {
    std::vector<double> stage_pressure;
    convection.at_stage(increment, stage_pressure, potential);
    layers_->advance(beta, stage_pressure, potential, stage);
    walls_->advance(beta, stage_pressure, stage);
  }
  auto& earlier = state.earlier;
  if (earlier.size() == kEarlierPressures) earlier.pop_back();
  earlier.insert(earlier.begin(), state.p);
  convection.finish(increment, stage);
  alpha.finish(stage, step.dt, keeps_rates_, state);
  return true;
}

}  // namespace vocalis::acoustic
