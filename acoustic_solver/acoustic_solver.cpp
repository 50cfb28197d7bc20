#include "acoustic_solver/acoustic_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "acoustic_solver/pressure_system.hpp"
#include "acoustic_solver/wave_operator.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

constexpr std::size_t kEarlierPressures = 3;
constexpr int kLargestPasses = 30;
// A pass leaves an error |β| dt / h times as large as it finds: a change so much above the solver's tolerance is
// enough.
constexpr double kPassTolerance = 100;

void check(const AcousticSettings& settings) {
  const auto positive = [&](double value, const char* name) {
    if (value > 0) return;
    throw base::UserError(fmt::format("{} of acoustic solver '{}' is positive", name, settings.name),
                          fmt::format("{}", value), fmt::format("set {} > 0", name));
  };
  positive(settings.speed_of_sound, "speed_of_sound");
  positive(settings.density, "density");
  positive(settings.step, "dt");
  positive(settings.solver_tolerance, "solver_tolerance");
  if (settings.theta < 0.5 || settings.theta > 1) {
    throw base::UserError(fmt::format("theta of acoustic solver '{}' lies in [0.5, 1]", settings.name),
                          fmt::format("{}", settings.theta), "0.5 keeps the energy, more damps it");
  }
}

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

struct AcousticSolver::Discretisation {
  Discretisation(const mesh::Mesh& on, const AcousticSettings& settings)
      : mesh(&on),
        space(fem::lagrange(on, 1)),
        wave(on, space, settings),
        system(on, space, wave.released(), settings.solver_tolerance) {}

  double norm(const std::vector<double>& owned_values) const {
    double square = 0;
    for (std::int32_t i = 0; i < space.dofs.num_owned; ++i) square += owned_values[i] * owned_values[i];
    return std::sqrt(base::sum(mesh->comm, square));
  }

  const mesh::Mesh* mesh;
  fem::Space space;
  WaveOperator wave;
  PressureSystem system;
};

struct AcousticSolver::SubStep {
  double dt = 0;  ///< [s]
  bool moves = false;
  std::vector<double> load;  ///< (Q, q) at the θ-point, at the owners
  double flux = 0;           ///< g at the θ-point [m/s]
};

AcousticSolver::AcousticSolver(const mesh::Mesh& mesh, const AcousticSettings& settings) : settings_(settings) {
  check(settings_);
  discretisation_ = std::make_unique<Discretisation>(mesh, settings_);
  state_.p.assign(mesh.num_vertices(), 0.0);
  state_.psi.assign(mesh.num_vertices(), 0.0);
}

AcousticSolver::~AcousticSolver() = default;
AcousticSolver::AcousticSolver(AcousticSolver&&) noexcept = default;
AcousticSolver& AcousticSolver::operator=(AcousticSolver&&) noexcept = default;

void AcousticSolver::set_state(State state) {
  assert(state.p.size() == state_.p.size() && state.psi.size() == state_.psi.size());
  state_ = std::move(state);
  drop_caches();
}

void AcousticSolver::drop_caches() { discretisation_->system.drop(); }

void AcousticSolver::adopt(const mesh::Mesh& mesh, State carried) {
  discretisation_ = std::make_unique<Discretisation>(mesh, settings_);
  assert(carried.p.size() == static_cast<std::size_t>(mesh.num_vertices()));
  state_ = std::move(carried);
}

const fem::Space& AcousticSolver::space() const { return discretisation_->space; }

fem::Field AcousticSolver::pressure() const {
  fem::Field field(space(), 1);
  field.values = state_.p;
  return field;
}

double AcousticSolver::energy() const { return discretisation_->wave.energy(state_.p, state_.psi); }

AdvanceReport AcousticSolver::advance(double dt, const Motion& motion, const Source& source,
                                      const std::function<void(double)>& on_substep) {
  assert(dt > 0 && motion.begin.size() == motion.end.size() && !source.begin == !source.end);
  auto& [mesh, space, wave, system] = *discretisation_;
  const std::size_t num_coordinates = mesh->coordinates.size();
  std::vector<double> middle(num_coordinates), velocity;
  bool moves = !motion.begin.empty() && !std::equal(motion.begin.begin(), motion.begin.end(), motion.end.begin());
  moves = base::largest(mesh->comm, static_cast<std::int32_t>(moves)) > 0;
  if (moves) {
    velocity.resize(num_coordinates);
    for (std::size_t i = 0; i < num_coordinates; ++i) velocity[i] = (motion.end[i] - motion.begin[i]) / dt;
  } else {
    const auto still = motion.begin.empty() ? std::span<const double>(mesh->coordinates) : motion.begin;
    const auto changed = static_cast<std::int32_t>(wave.set_geometry(still));
    if (base::largest(mesh->comm, changed) > 0) system.drop();
  }
  wave.set_velocity(velocity);

  const int count = std::max(1, static_cast<int>(std::ceil(dt / settings_.step * (1 - 1e-9))));
  const double theta = settings_.theta;
  const double start = state_.time;
  AdvanceReport report;
  SubStep step;
  step.dt = dt / count;
  step.moves = moves;
  for (int s = 0; s < count; ++s) {
    const double at_theta = (s + theta) / count;
    if (moves) {
      const double at_middle = (s + 0.5) / count;
      for (std::size_t i = 0; i < num_coordinates; ++i) {
        middle[i] = (1 - at_middle) * motion.begin[i] + at_middle * motion.end[i];
      }
      wave.set_geometry(middle);
    }
    const double a = 1 / (theta * step.dt), b = theta * step.dt / settings_.density;
    if (moves || !system.is_assembled(a, b)) system.assemble(wave, a, b);
    step.load.assign(mesh->num_vertices(), 0.0);
    if (source.begin) {
      for (std::int32_t v = 0; v < space.dofs.num_owned; ++v) {
        step.load[v] = (1 - at_theta) * source.begin->values[v] + at_theta * source.end->values[v];
      }
    }
    if (source.flux) {
      step.flux = (1 - theta) * source.flux(start + s * step.dt) + theta * source.flux(start + (s + 1) * step.dt);
    }
    if (!advance_sub_step(step, report)) return report;
    state_.time = s + 1 == count ? start + dt : start + (s + 1) * step.dt;
    ++report.sub_steps;
    if (on_substep) on_substep(state_.time);
  }
  return report;
}

bool AcousticSolver::advance_sub_step(const SubStep& step, AdvanceReport& report) {
  // Unknown: δ = p_θ - p at the θ-point, where ψ_θ = ψ + θ dt (p_θ / ρ + β·∇ψ_θ). With it the mass of p drops out:
  //   (mass / (θ dt) + admittance + b stiffness) δ = load - admittance p - stiffness (ψ + b p) + terms with β.
  auto& [mesh, space, wave, system] = *discretisation_;
  const double theta = settings_.theta;
  const double b = theta * step.dt / settings_.density;
  const std::size_t num_vertices = state_.p.size();
  std::vector<double> fixed(num_vertices, 0.0), potential(num_vertices);
  for (std::size_t v = 0; v < num_vertices; ++v) potential[v] = state_.psi[v] + b * state_.p[v];
  wave.add_flux(step.flux, fixed);
  wave.add_admittance(-1, state_.p, fixed);
  wave.add_stiffness(-1, potential, fixed);
  space.halo.add_to_owners(fixed);
  for (std::size_t v = 0; v < num_vertices; ++v) fixed[v] += step.load[v];

  std::vector<double> increment = extrapolated_increment(state_);
  for (double& value : increment) value *= theta;
  std::vector<double> right_hand_side = fixed, convection(num_vertices, 0.0), difference, middle_pressure, scaled;
  const auto update_convection = [&] {
    middle_pressure = state_.p;
    for (std::size_t v = 0; v < num_vertices; ++v) {
      middle_pressure[v] += increment[v];
      potential[v] = state_.psi[v] + b * middle_pressure[v] + theta * step.dt * convection[v];
    }
    wave.potential_convection(potential, middle_pressure, convection);
  };
  if (step.moves) update_convection();
  for (int pass = 0;; ++pass) {
    if (step.moves) {
      scaled = convection;
      for (double& value : scaled) value *= theta * step.dt;
      std::vector<double> terms(num_vertices, 0.0);
      wave.add_convection(middle_pressure, terms);
      wave.add_stiffness(-1, scaled, terms);
      space.halo.add_to_owners(terms);
      difference = right_hand_side;
      for (std::size_t v = 0; v < num_vertices; ++v) right_hand_side[v] = fixed[v] + terms[v];
      for (std::size_t v = 0; v < num_vertices; ++v) difference[v] -= right_hand_side[v];
      for (const std::int32_t v : wave.released()) difference[v] = 0;
      const double tolerance = kPassTolerance * settings_.solver_tolerance;
      if (pass > 0 && discretisation_->norm(difference) <= tolerance * discretisation_->norm(right_hand_side)) break;
      if (pass == kLargestPasses) {
        report.converged = false;
        report.reason = fmt::format("the terms of the mesh's motion did not converge in {} passes", kLargestPasses);
        return false;
      }
    }
    const la::SolveReport solved = system.solve(right_hand_side, increment);
    report.linear_iterations += solved.iterations;
    ++report.passes;
    if (!solved.converged) {
      report.converged = false;
      report.reason = "pressure system: " + solved.reason;
      return false;
    }
    space.halo.copy_to_ghosts(increment);
    if (!step.moves) break;
    update_convection();
  }

  auto& earlier = state_.earlier;
  if (earlier.size() == kEarlierPressures) earlier.pop_back();
  earlier.insert(earlier.begin(), state_.p);
  for (std::size_t v = 0; v < num_vertices; ++v) {
    state_.psi[v] += step.dt * ((state_.p[v] + increment[v]) / settings_.density + convection[v]);
    state_.p[v] += increment[v] / theta;
  }
  return true;
}

}  // namespace vocalis::acoustic
