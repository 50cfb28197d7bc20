#include "coupling/run_facts.hpp"

#include <algorithm>

#include "core/base/mpi.hpp"
#include "coupling/balance.hpp"

namespace vocalis::coupling {

namespace {

/// The flow's phases side by side: its whole step holds the assembly, which holds the motion of the mesh; what is left
/// of the step is the solution.
std::vector<base::Timers::Phase> flow_phases(std::vector<base::Timers::Phase> phases) {
  base::Timers::Phase assembly, motion;
  for (const auto& phase : phases) {
    if (phase.name == "mesh_motion") motion = phase;
    if (phase.name == "flow.assemble") assembly = phase;
  }
  const auto take_away = [](base::Timers::Phase& phase, const base::Timers::Phase& part) {
    phase.seconds -= part.seconds;
    phase.traffic -= part.traffic;
  };
  for (auto& phase : phases) {
    if (phase.name == "flow.assemble") take_away(phase, motion);
    if (phase.name != "flow.newton") continue;
    phase.name = "flow.solve";
    take_away(phase, assembly);
  }
  return phases;
}

/// Phases of the same name become one.
void add_phases(const std::vector<base::Timers::Phase>& more, std::vector<base::Timers::Phase>& phases) {
  for (const auto& phase : more) {
    const auto same = std::find_if(phases.begin(), phases.end(), [&](const auto& p) { return p.name == phase.name; });
    if (same == phases.end()) {
      phases.push_back(phase);
    } else {
      same->seconds += phase.seconds;
      same->calls += phase.calls;
      same->traffic += phase.traffic;
    }
  }
}

}  // namespace

RunFacts facts_of_scene(const Case& config, const Scene& scene, const Simulation& simulation) {
  RunFacts facts;
  facts.ranks = base::size(scene.parent.comm);
  facts.dimension = scene.parent.dimension;
  facts.cells["parent"] = scene.parent.cells.num_global;
  if (scene.flow) {
    facts.cells["flow"] = scene.flow->mesh.cells.num_global;
    facts.imbalance["flow"] = balance(scene.flow->mesh).imbalance();
    if (simulation.flow()) facts.unknowns["flow"] = simulation.flow()->num_unknowns();
  }
  if (scene.acoustic) {
    facts.cells["acoustic"] = scene.acoustic->mesh.cells.num_global;
    facts.imbalance["acoustic"] = balance(scene.acoustic->mesh).imbalance();
    facts.unknowns["acoustic"] = 2 * scene.acoustic->mesh.vertices.num_global;
  }
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) {
    const Voice& voice = *simulation.voices()[i];
    if (!voice.has_own_mesh()) continue;
    const std::string name = "acoustic." + config.acoustics[i].name;
    facts.cells[name] = voice.mesh().cells.num_global;
    facts.unknowns[name] = 2 * voice.mesh().vertices.num_global;
    facts.imbalance[name] = balance(voice.mesh()).imbalance();
  }
  return facts;
}

std::vector<base::Timers::Phase> phases_of(const Simulation& simulation, const base::Timers& timers) {
  std::vector<base::Timers::Phase> result;
  if (const fsi::FsiSolver* flow = simulation.flow()) result = flow_phases(flow->timers().phases());
  add_phases(timers.phases(), result);
  for (const auto& voice : simulation.voices()) add_phases(voice->timers().phases(), result);
  return result;
}

std::map<std::string, double> figures_of(const ContactReport& report) {
  const auto share = [](double part, double whole) { return whole > 0 ? part / whole : 0; };
  return {{"searches", report.searches},
          {"closings", report.closings},
          {"closed_steps", report.closed_steps},
          {"repeated_steps", report.repeated_steps},
          {"energy_lost_J", report.energy_lost},
          {"most_closed_cells", report.most_closed},
          {"share_of_open_steps", share(report.seconds_open, report.step_seconds_open)},
          {"share_of_closed_steps", share(report.seconds_closed, report.step_seconds_closed)}};
}

void add_rebuilds(const Case& config, const Simulation& simulation, Figures& figures) {
  for (std::size_t i = 0; i < config.acoustics.size(); ++i) {
    if (config.acoustics[i].contact_cells == acoustic::ContactCells::keep) continue;
    const std::string suffix = config.acoustics.size() > 1 ? "." + config.acoustics[i].name : "";
    const Rebuilds& rebuilds = simulation.voices()[i]->rebuilds();
    figures.values["acoustic_rebuilds" + suffix] = static_cast<double>(rebuilds.count);
    figures.values["acoustic_energy_lost_J" + suffix] = rebuilds.energy_lost;
  }
}

}  // namespace vocalis::coupling
