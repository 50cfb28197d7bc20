#include "acoustic_solver/acoustic_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "acoustic_solver/discretisation.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

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
  if (settings.subscale_constant < 0) {
    throw base::UserError(fmt::format("subscale_constant of acoustic solver '{}' is not negative", settings.name),
                          fmt::format("{}", settings.subscale_constant), "0.01 to 0.05 damp the sawteeth of P1/P1");
  }
  if (settings.velocity_elements == VelocityElements::p1 && settings.integrator == Integrator::leap_frog) {
    throw base::UserError("the explicit integrator of sound keeps velocities in P0", "velocity_elements = \"P1\"",
                          "write velocity_elements = \"P0\", or integrator = \"implicit\"");
  }
  const bool has_pml = std::any_of(settings.layers.begin(), settings.layers.end(),
                                   [](const AbsorbingLayer& layer) { return layer.kind == LayerKind::pml; });
  if (settings.velocity_elements == VelocityElements::p1 && has_pml) {
    throw base::UserError("a perfectly matched layer keeps its fields in P0, as velocities are there",
                          "velocity_elements = \"P1\"", "write velocity_elements = \"P0\", or take a sponge");
  }
  if (settings.spectral_radius < 0 || settings.spectral_radius > 1) {
    throw base::UserError(fmt::format("spectral_radius of acoustic solver '{}' lies in [0, 1]", settings.name),
                          fmt::format("{}", settings.spectral_radius), "1 keeps the energy, less damps what is fast");
  }
  if (settings.spectral_radius < 1 && settings.integrator == Integrator::leap_frog) {
    throw base::UserError(
        fmt::format("spectral_radius of acoustic solver '{}' belongs to the implicit integrator", settings.name),
        fmt::format("{} with integrator = \"explicit\"", settings.spectral_radius),
        "leave spectral_radius out, or set integrator = \"implicit\"");
  }
  if (!settings.layers.empty() && settings.integrator == Integrator::leap_frog) {
    throw base::UserError(
        fmt::format("absorbing layers of acoustic solver '{}' need the implicit integrator", settings.name),
        "integrator = \"explicit\"", "set integrator = \"implicit\" or \"auto\", or take the layers out");
  }
  if (has_yielding_walls(settings) && settings.integrator == Integrator::leap_frog) {
    throw base::UserError(
        fmt::format("yielding and viscothermal walls of acoustic solver '{}' need the implicit integrator",
                    settings.name),
        "integrator = \"explicit\"", "set integrator = \"implicit\" or \"auto\", or another kind of wall");
  }
}

}  // namespace

AcousticSolver::AcousticSolver(const mesh::Mesh& mesh, const AcousticSettings& settings)
    : AcousticSolver(settings, [&] {
        check(settings);
        return std::make_shared<Discretisation>(mesh, settings);
      }()) {}

AcousticSolver AcousticSolver::beside(const AcousticSolver& other, const AcousticSettings& settings) {
  assert(differ_in_source_alone(other.settings_, settings));
  other.discretisation_->is_shared = true;
  return {settings, other.discretisation_};
}

AcousticSolver::AcousticSolver(const AcousticSettings& settings, std::shared_ptr<Discretisation> discretisation)
    : settings_(settings), discretisation_(std::move(discretisation)) {
  state_.p.assign(discretisation_->mesh->num_vertices(), 0.0);
  state_.psi.assign(discretisation_->mesh->num_vertices(), 0.0);
  discretisation_->layers.prepare(state_);
  discretisation_->walls.prepare(state_);
}

AcousticSolver::~AcousticSolver() = default;
AcousticSolver::AcousticSolver(AcousticSolver&&) noexcept = default;
AcousticSolver& AcousticSolver::operator=(AcousticSolver&&) noexcept = default;

void AcousticSolver::set_state(State state) {
  assert(state.p.size() == state_.p.size() && state.psi.size() == state_.psi.size());
  state_ = std::move(state);
  const auto prepare = [this](Unknowns& unknowns) {
    discretisation_->layers.prepare(unknowns);
    discretisation_->walls.prepare(unknowns);
  };
  prepare(state_);
  if (state_.has_rates) prepare(state_.rates);
  drop_caches();
}

void AcousticSolver::drop_caches() { discretisation_->drop(); }

const fem::Space& AcousticSolver::space() const { return discretisation_->space; }

fem::Field AcousticSolver::pressure() const {
  fem::Field field(space(), 1);
  field.values = state_.p;
  return field;
}

double AcousticSolver::energy() const {
  return discretisation_->wave.energy(state_.p, state_.psi) + discretisation_->walls.energy(state_);
}

IntegratorChoice AcousticSolver::choice(double dt, bool moves, bool flows) const {
  const bool is_open = settings_.integrator == Integrator::automatic && !moves && !flows;
  const double stable_step = is_open ? discretisation_->bound() : 0;
  return choose_integrator(settings_, discretisation_->mesh->dimension, {moves, flows}, dt, stable_step);
}

void AcousticSolver::settle_released(std::span<const double> values) {
  const WaveOperator& wave = discretisation_->wave;
  for (const std::int32_t v : wave.released()) state_.p[v] = values.empty() ? 0 : values[v];
  if (wave.has_inlets()) {
    std::vector<double> rates;
    wave.potential_convection(state_.psi, state_.p, rates,
                              discretisation_->walls.velocities(settings_.step, state_.p, state_));
    for (const std::int32_t v : wave.inlets()) state_.p[v] = -settings_.density * rates[v];
  }
  space().halo.copy_to_ghosts(state_.p);
}

double AcousticSolver::stable_step(bool moves, const std::function<void(double)>& place_at) {
  auto& here = *discretisation_;
  double result = std::numeric_limits<double>::infinity();
  if (!moves) result = here.leap_frog.stable_step(false);
  for (const double at : {0.0, 1.0}) {
    if (!moves) break;
    place_at(at);
    result = std::min(result, here.leap_frog.stable_step(true));
  }
  // Downstream sound goes faster by the flow.
  const double flow_speed = base::largest(here.mesh->comm, here.wave.largest_flow_speed());
  return result / (1 + flow_speed / settings_.speed_of_sound);
}

bool AcousticSolver::place(double dt, const Motion& motion) {
  const mesh::Mesh& mesh = *discretisation_->mesh;
  WaveOperator& wave = discretisation_->wave;
  const bool differs = !std::equal(motion.begin.begin(), motion.begin.end(), motion.end.begin());
  const bool moves = base::largest(mesh.comm, static_cast<std::int32_t>(differs)) > 0;
  std::vector<double> velocity;
  if (moves) {
    velocity.resize(mesh.coordinates.size());
    for (std::size_t i = 0; i < velocity.size(); ++i) velocity[i] = (motion.end[i] - motion.begin[i]) / dt;
  } else {
    const auto still = motion.begin.empty() ? std::span<const double>(mesh.coordinates) : motion.begin;
    const auto changed = static_cast<std::int32_t>(wave.set_geometry(still));
    if (base::largest(mesh.comm, changed) > 0) discretisation_->drop();
  }
  wave.set_velocity(velocity, motion.convection);
  const Layers& layers = discretisation_->layers;
  if (wave.flows() && layers.exist() && !layers.stand_still(motion.convection)) {
    throw base::UserError(fmt::format("the medium in the layers of acoustic solver '{}' is at rest", settings_.name),
                          "it flows there",
                          "make the layers thinner or the air wider, or let the flow end in front of them");
  }
  if (moves && layers.exist() && !layers.stand_still(velocity)) {
    throw base::UserError(fmt::format("the mesh in the layers of acoustic solver '{}' stands still", settings_.name),
                          "it moves there", "make the layers thinner or the air wider");
  }
  return moves;
}

AdvanceReport AcousticSolver::advance(double dt, const Motion& motion, const Source& source,
                                      const std::function<void(double)>& on_substep) {
  assert(dt > 0 && motion.begin.size() == motion.end.size() && !source.begin == !source.end);
  auto& here = *discretisation_;
  const bool moves = place(dt, motion);
  std::vector<double> coordinates(motion.begin.size());
  const auto place_at = [&](double at) {
    for (std::size_t i = 0; i < coordinates.size(); ++i) {
      coordinates[i] = (1 - at) * motion.begin[i] + at * motion.end[i];
    }
    here.wave.set_geometry(coordinates);
  };
  AdvanceReport report;
  const int count = count_sub_steps(dt, settings_.step);
  const double start = state_.time;
  const bool flows = here.wave.flows();
  settle_released(source.released);
  const bool is_explicit = choice(dt, moves, flows).integrator == Integrator::leap_frog;
  int parts = 1;
  if (is_explicit) {
    const double longest = stable_step(moves, place_at);
    parts = count_sub_steps(dt / count, kPartOfStableStep * longest);
    if (parts == 0) {
      report.converged = false;
      report.reason = fmt::format(
          "the explicit integrator's stable step fell to {:.1e} s: a cell of the moving mesh closes", longest);
      return report;
    }
  }
  SubStep step;
  step.dt = dt / count;
  step.moves = moves;
  step.convects = moves || flows;
  step.is_shared = here.is_shared && moves;
  step.flux_at = source.flux;
  for (int s = 0; s < count; ++s) {
    step.begin = start + s * step.dt;
    if (step.is_shared) step.slot = s;
    const double stage = is_explicit ? 0.5 : here.implicit().stage_at(state_), at_stage = (s + stage) / count;
    if (moves) step.place = [&](double part) { place_at((s + part) / count); };
    if (source.begin) {
      step.load.assign(here.mesh->num_vertices(), 0.0);
      step.load_change.assign(here.mesh->num_vertices(), 0.0);
      for (std::int32_t v = 0; v < here.space.dofs.num_owned; ++v) {
        step.load[v] = (1 - at_stage) * source.begin->values[v] + at_stage * source.end->values[v];
        step.load_change[v] = (source.end->values[v] - source.begin->values[v]) / count;
      }
    }
    if (source.flux) step.flux = (1 - stage) * source.flux(step.begin) + stage * source.flux(step.begin + step.dt);
    if (moves && !is_explicit) step.place(stage);
    const bool done = is_explicit ? here.leap_frog.advance(step, parts, state_, report)
                                  : here.implicit().advance(step, state_, report);
    if (!done) return report;
    state_.time = s + 1 == count ? start + dt : start + (s + 1) * step.dt;
    report.sub_steps += parts;
    if (on_substep) on_substep(state_.time);
  }
  return report;
}

}  // namespace vocalis::acoustic
