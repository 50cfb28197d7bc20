#include "acoustic_solver/acoustic_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "acoustic_solver/implicit_step.hpp"
#include "acoustic_solver/wave_operator.hpp"
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
  if (settings.theta < 0.5 || settings.theta > 1) {
    throw base::UserError(fmt::format("theta of acoustic solver '{}' lies in [0.5, 1]", settings.name),
                          fmt::format("{}", settings.theta), "0.5 keeps the energy, more damps it");
  }
}

}  // namespace

struct AcousticSolver::Discretisation {
  Discretisation(const mesh::Mesh& on, const AcousticSettings& settings)
      : mesh(&on),
        space(fem::lagrange(on, 1)),
        wave(on, space, settings),
        layers(on, settings),
        integrator(on, space, wave, layers, settings) {}

  const mesh::Mesh* mesh;
  fem::Space space;
  WaveOperator wave;
  Layers layers;
  ImplicitStep integrator;
};

AcousticSolver::AcousticSolver(const mesh::Mesh& mesh, const AcousticSettings& settings) : settings_(settings) {
  check(settings_);
  discretisation_ = std::make_unique<Discretisation>(mesh, settings_);
  state_.p.assign(mesh.num_vertices(), 0.0);
  state_.psi.assign(mesh.num_vertices(), 0.0);
  discretisation_->layers.prepare(state_);
}

AcousticSolver::~AcousticSolver() = default;
AcousticSolver::AcousticSolver(AcousticSolver&&) noexcept = default;
AcousticSolver& AcousticSolver::operator=(AcousticSolver&&) noexcept = default;

void AcousticSolver::set_state(State state) {
  assert(state.p.size() == state_.p.size() && state.psi.size() == state_.psi.size());
  state_ = std::move(state);
  discretisation_->layers.prepare(state_);
  drop_caches();
}

void AcousticSolver::drop_caches() { discretisation_->integrator.drop(); }

void AcousticSolver::adopt(const mesh::Mesh& mesh, State carried) {
  discretisation_ = std::make_unique<Discretisation>(mesh, settings_);
  assert(carried.p.size() == static_cast<std::size_t>(mesh.num_vertices()));
  state_ = std::move(carried);
  discretisation_->layers.prepare(state_);
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
  auto& [mesh, space, wave, layers, integrator] = *discretisation_;
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
    if (base::largest(mesh->comm, changed) > 0) integrator.drop();
  }
  wave.set_velocity(velocity);
  if (moves && layers.exist() && !layers.stand_still(velocity)) {
    throw base::UserError(fmt::format("the mesh in the layers of acoustic solver '{}' stands still", settings_.name),
                          "it moves there", "make the layers thinner or the air wider");
  }

  const int count = std::max(1, static_cast<int>(std::ceil(dt / settings_.step * (1 - 1e-9))));
  const double theta = integrator.load_at();
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
    step.load.assign(mesh->num_vertices(), 0.0);
    if (source.begin) {
      for (std::int32_t v = 0; v < space.dofs.num_owned; ++v) {
        step.load[v] = (1 - at_theta) * source.begin->values[v] + at_theta * source.end->values[v];
      }
    }
    if (source.flux) {
      step.flux = (1 - theta) * source.flux(start + s * step.dt) + theta * source.flux(start + (s + 1) * step.dt);
    }
    if (!integrator.advance(step, state_, report)) return report;
    state_.time = s + 1 == count ? start + dt : start + (s + 1) * step.dt;
    ++report.sub_steps;
    if (on_substep) on_substep(state_.time);
  }
  return report;
}

}  // namespace vocalis::acoustic
