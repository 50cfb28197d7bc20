#include "coupling/simulation.hpp"

#include <algorithm>
#include <map>

#include "core/base/stopwatch.hpp"

namespace vocalis::coupling {

Simulation::Simulation(Scene& scene, const Case& config, base::Timers& timers) : scene_(scene), timers_(timers) {
  clock_.end = config.time.end;
  clock_.nominal_step = config.time.step;
  clock_.largest_step = std::max(config.time.largest_step, config.time.step);
  clock_.tolerance = config.flow ? config.time.tolerance : 0;
  clock_.smallest_step = config.time.smallest_step > 0 ? config.time.smallest_step : config.time.step / 64;
  if (config.flow) {
    flow_ = std::make_unique<fsi::FsiSolver>(scene.flow->mesh, *config.flow, config.time);
    if (config.contact) contact_ = std::make_unique<ContactFollower>(*flow_, *config.contact);
    solved_.emplace(scene, *flow_);
    monitors_ = std::make_unique<Monitors>(*flow_, config.monitors);
    if (config.statistics) check_statistics(*config.statistics, monitors_->columns());
  }
  if (config.given_flow) {
    given_ = make_given_flow(*config.given_flow, scene);
    clock_.end = std::min(clock_.end, given_->end());
  }
  if (config.has_flow()) begin_flow(config);
  if (config.source) source_.emplace(config.source->pulse);
  for (const acoustic::AcousticSettings& settings : config.acoustics) {
    voices_.push_back(std::make_unique<Voice>(scene, config, settings, voice_beside(config, settings)));
  }
}

/// A voice that takes the same steps on the same mesh as one with these settings would.
const Voice* Simulation::voice_beside(const Case& config, const acoustic::AcousticSettings& settings) const {
  if (settings.contact_cells == acoustic::ContactCells::strip) return nullptr;
  for (const auto& voice : voices_) {
    if (own_mesh_table(config, voice->solver().settings().name) != own_mesh_table(config, settings.name)) continue;
    const bool lags_alike = voice->derivative() == settings.analogy.pressure_derivative;
    if (lags_alike && differ_in_source_alone(voice->solver().settings(), settings)) return voice.get();
  }
  return nullptr;
}

void Simulation::begin_flow(const Case& config) {
  int depth = snapshots_for(PressureDerivative::step);
  for (const auto& settings : config.acoustics) {
    depth = std::max(depth, snapshots_for(settings.analogy.pressure_derivative));
  }
  history_.emplace(scene_, depth, given_ ? given_->can_close() : config.contact.has_value());
  history_->restart(flow_now());
  if (!config.surface_microphones.empty()) surface_microphones_ = std::make_unique<SurfaceMicrophones>(scene_, config);
}

FlowSnapshot Simulation::flow_after(long steps, double time) const {
  if (!given_) return solved_->snapshot();
  const auto scope = timers_.scope("given_flow");
  return given_->snapshot(steps, time);
}

StepOutcome Simulation::step() {
  const base::Stopwatch watch;
  StepOutcome outcome =
      flow_ ? step_flow() : StepOutcome{.failure = "", .dt = given_ ? given_->dt(clock_) : clock_.dt()};
  if (!outcome.failure.empty()) return outcome;
  if (history_) history_->add(flow_after(clock_.step + 1, clock_.time + outcome.dt));
  if (surface_microphones_) step_surfaces();
  step_voices(outcome.dt, outcome);
  if (outcome.failure.empty()) clock_.advance(outcome.dt, outcome.local_error);
  if (contact_) contact_->count_step(watch.seconds());
  return outcome;
}

StepOutcome Simulation::step_flow() {
  StepOutcome outcome;
  if (contact_) begin_contact();
  while (!try_flow_step(outcome)) {
    if (!outcome.failure.empty()) return outcome;
  }
  flow_->accept();
  if (contact_) contact_->accept();
  monitors_->follow_step();
  return outcome;
}

void Simulation::begin_contact() {
  const auto scope = timers_.scope("contact");
  contact_->begin_step();
}

/// Whether the step may be accepted; if not, dt has become smaller, or the failure is told.
bool Simulation::try_flow_step(StepOutcome& outcome) {
  outcome.dt = clock_.dt();
  const auto report = flow_->try_step(outcome.dt);
  outcome.newton_iterations += report.newton_iterations;
  outcome.jacobians += report.jacobians;
  outcome.local_error = report.local_error;
  outcome.smallest_quality = report.smallest_quality;
  if (!report.converged) {
    if (clock_.can_shrink()) {
      clock_.shrink();
    } else {
      outcome.failure = "the flow's step did not converge with the smallest dt: " + report.reason;
    }
    return false;
  }
  if (clock_.is_too_coarse(report.local_error)) {
    clock_.refine(report.local_error);
    return false;
  }
  if (!contact_) return true;
  const auto scope = timers_.scope("contact");
  const auto verdict = contact_->judge_step();
  outcome.failure = verdict.failure;
  if (!verdict.failure.empty()) return false;
  if (!verdict.is_too_deep || !clock_.can_shrink()) return true;
  contact_->count_repeated_step();
  clock_.shrink();
  return false;
}

void Simulation::step_surfaces() {
  const auto scope = timers_.scope("surfaces");
  const auto& snapshots = history_->snapshots();
  surface_microphones_->follow(snapshots[snapshots.size() - 2], snapshots.back());
}

void Simulation::step_voices(double dt, StepOutcome& outcome) {
  std::map<PressureDerivative, FlowStep> steps;  // voices with the same derivative follow the same step
  const auto step_for = [&](PressureDerivative derivative) -> const FlowStep& {
    const auto scope = timers_.scope("analogy");
    if (!steps.contains(derivative)) steps.emplace(derivative, history_->step(derivative));
    return steps.at(derivative);
  };
  for (auto& voice : voices_) {
    acoustic::AdvanceReport report;
    if (!history_) {
      report = voice->drive(dt, [this](double time) { return source_ ? source_->value(time) : 0.0; });
    } else if (history_->has_step(voice->derivative())) {
      report = voice->follow(step_for(voice->derivative()));
    }
    outcome.acoustic_iterations += report.linear_iterations;
    if (!report.converged) outcome.failure = "the acoustic step did not converge: " + report.reason;
  }
}

void Simulation::follow_contact() {
  if (!history_) return;
  for (auto& voice : voices_) {
    const FlowSnapshot& flow = history_->followed(voice->derivative());
    voice->follow_contact(flow.in_contact, history_->displacement(flow));
  }
}

std::vector<double> Simulation::monitor_values() const {
  if (!monitors_) return {};
  return monitors_->evaluate();
}

void Simulation::drop_caches() {
  if (flow_) flow_->drop_caches();
  if (contact_) contact_->drop_caches();
  for (auto& voice : voices_) voice->drop_caches();
}

void Simulation::restart_from_states() {
  if (history_) {
    for (auto& voice : voices_) voice->move_to(history_->displacement(history_->followed(voice->derivative())));
  }
  drop_caches();
}

}  // namespace vocalis::coupling
