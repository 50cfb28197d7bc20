#include "coupling/run.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/base/error.hpp"
#include "core/base/first_rank.hpp"
#include "core/base/log.hpp"
#include "core/base/mpi.hpp"
#include "core/base/stopwatch.hpp"
#include "coupling/checkpoint_state.hpp"
#include "coupling/run_facts.hpp"
#include "coupling/run_folder.hpp"
#include "coupling/run_output.hpp"
#include "coupling/sound/sound_comparison.hpp"
#include "coupling/sound/sound_table.hpp"
#include "coupling/summary.hpp"

namespace vocalis::coupling {

namespace {

constexpr int finished_code = 0, failed_code = 3;

std::string checkpoint_path(const std::string& folder) {
  return (std::filesystem::path(folder) / "checkpoint.h5").string();
}

/// One run from its present state to the end of the case or of its budget of steps.
class Run {
 public:
  Run(MPI_Comm comm, const Case& config, bool goes_on)
      : comm_(comm), config_(config), folder_(config.output.directory), log_(comm) {
    log_.open_file((std::filesystem::path(folder_) / "log.txt").string(), goes_on);
    log_.info("Vocalis {}: {} on {} ranks, into {}", VOCALIS_VERSION, config.name, base::size(comm), folder_);
    scene_ = build_scene(comm, config);
    simulation_ = std::make_unique<Simulation>(*scene_, config, timers_);
    if (goes_on) {
      facts_before_ = load_checkpoint(checkpoint_path(folder_), config, *scene_, *simulation_);
      log_.info("goes on from step {} at {:.6g} s", simulation_->clock().step, simulation_->clock().time);
    }
    output_ = std::make_unique<RunOutput>(config, folder_, *scene_, *simulation_, goes_on);
    facts_ = facts_of_scene(config, *scene_, *simulation_);
    for (const auto& [mesh, cells] : facts_.cells) log_.info("  {:<9} {:>9} cells", mesh, cells);
    for (const auto& [mesh, unknowns] : facts_.unknowns) log_.info("  {:<9} {:>9} unknowns", mesh, unknowns);
    for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
      log_.info("  {:<9} {}", config.acoustics[i].name, simulation_->voices()[i]->integrator_words());
    }
    if (!goes_on) checkpoint();
  }

  int go(long largest_steps) {
    while (!simulation_->clock().done()) {
      if (largest_steps > 0 && facts_.counted_steps >= largest_steps) return end("stopped", "--steps", 0);
      const StepOutcome outcome = counted_step();
      if (!outcome.failure.empty()) return end("failed", outcome.failure, failed_code);
      const Clock& clock = simulation_->clock();
      {
        const auto scope = timers_.scope("output");
        output_->record(*simulation_, outcome);
        if (config_.output.checkpoint_steps > 0 && clock.step % config_.output.checkpoint_steps == 0) checkpoint();
      }
      log_.progress({clock.step, clock.time, clock.end, outcome.dt, outcome.newton_iterations});
    }
    return end("finished", "", finished_code);
  }

 private:
  StepOutcome counted_step() {
    const base::Traffic before = base::traffic();
    StepOutcome outcome = simulation_->step();
    facts_.traffic += base::traffic();
    facts_.traffic -= before;
    if (outcome.failure.empty()) ++facts_.counted_steps;
    return outcome;
  }

  void checkpoint() {
    output_->flush(*simulation_);
    save_checkpoint(checkpoint_path(folder_), config_, *scene_, *simulation_, {wall_seconds()});
    simulation_->drop_caches();
  }

  double wall_seconds() const { return facts_before_.wall_seconds + watch_.seconds(); }

  int end(const std::string& status, const std::string& reason, int code) {
    log_.end_progress();
    output_->flush(*simulation_);
    const Clock& clock = simulation_->clock();
    facts_.status = status;
    facts_.reason = reason;
    facts_.steps = clock.step;
    facts_.rejected_steps = clock.rejected;
    facts_.simulated_seconds = clock.time;
    facts_.wall_seconds = wall_seconds();
    facts_.phases = base::largest_over_ranks(comm_, phases_of(*simulation_, timers_));
    if (const ContactFollower* contact = simulation_->contact()) facts_.contact = figures_of(contact->report());
    facts_.traffic = base::largest(comm_, facts_.traffic);
    facts_.peak_memory_bytes = base::sum(comm_, peak_memory_bytes());
    base::on_first_rank(comm_, [&] {
      Figures figures = evaluate_run(config_, folder_);
      if (simulation_->history() && simulation_->history()->can_close()) add_rebuilds(config_, *simulation_, figures);
      write_summary((std::filesystem::path(folder_) / "summary.json").string(), config_, facts_, figures);
      print_table(log_, config_, facts_, figures);
    });
    return code;
  }

  MPI_Comm comm_;
  const Case& config_;
  std::string folder_;
  base::Stopwatch watch_;
  base::Log log_;
  base::Timers timers_;
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Simulation> simulation_;
  std::unique_ptr<RunOutput> output_;
  RunFacts facts_;
  CheckpointFacts facts_before_;
};

/// Tells the start script which folder the report is to be made of. Rank 0.
void note_run_folder(MPI_Comm comm, const std::string& folder) {
  const char* note = std::getenv("VOCALIS_NOTE");
  if (note && base::rank(comm) == 0) std::ofstream(note) << std::filesystem::absolute(folder).string() << '\n';
}

/// A record must outlive the run that is made of it. Collective.
void require_record_elsewhere(MPI_Comm comm, const Case& config) {
  const auto* record = config.given_flow ? std::get_if<FlowRecord>(&*config.given_flow) : nullptr;
  if (!record) return;
  base::on_first_rank(comm, [&] {
    const std::filesystem::path folder = std::filesystem::path(record->file).parent_path();
    if (!std::filesystem::exists(config.output.directory)) return;
    if (!std::filesystem::equivalent(folder, config.output.directory)) return;
    throw base::UserError("a run must not be written over the record of its flow", config.output.directory,
                          "choose another folder with --out DIR");
  });
}

int run_from_start(MPI_Comm comm, const Case& config, long steps) {
  require_record_elsewhere(comm, config);
  prepare_run_folder(comm, config.output.directory);
  note_run_folder(comm, config.output.directory);
  write_resolved(comm, config, (std::filesystem::path(config.output.directory) / "resolved.toml").string());
  return Run(comm, config, false).go(steps);
}

/// The case of a run folder: its resolved.toml, which names all values, with the folder itself as the place. Throws
/// UserError if there is none.
Case case_of_folder(MPI_Comm comm, const std::string& folder) {
  const std::string file = (std::filesystem::path(folder) / "resolved.toml").string();
  base::on_first_rank(comm, [&] {
    if (std::filesystem::is_regular_file(file)) return;
    throw base::UserError(folder + " must be a run folder",
                          std::filesystem::exists(folder) ? "no resolved.toml in it" : "nothing of this name",
                          "name a folder that a run has written, for example runs/quick");
  });
  Case config = read_case(comm, file, {});
  config.output.directory = folder;
  return config;
}

}  // namespace

int run(MPI_Comm comm, const Command& command) {
  return run_from_start(comm, read_case(comm, command.target, command.overrides), command.steps);
}

int replay(MPI_Comm comm, const Command& command) {
  return run_from_start(comm, read_replay(comm, command.target, command.overrides), command.steps);
}

int resume(MPI_Comm comm, const Command& command) {
  const Case config = case_of_folder(comm, command.target);
  note_run_folder(comm, config.output.directory);
  return Run(comm, config, true).go(command.steps);
}

int spectrum(MPI_Comm comm, const Command& command) {
  const Case config = case_of_folder(comm, command.target);
  base::Log log(comm);
  base::on_first_rank(comm, [&] {
    const Figures figures = evaluate_run(config, command.target);
    print_sounds(log, figures.sounds);
    print_comparisons(log, compare_sounds(figures.sounds));
    for (const auto& [name, value] : figures.values) log.info("  {:<28} {:>12.6g}", name, value);
  });
  return finished_code;
}

}  // namespace vocalis::coupling
