#include "coupling/checkpoint_state.hpp"

#include <bit>
#include <deque>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/io/checkpoint.hpp"
#include "coupling/checkpoint_arrays.hpp"

namespace vocalis::coupling {

namespace {

/// A number that changes with any coordinate (at rest) or cell of this rank's part of a mesh (FNV-1a).
std::int64_t fingerprint(const mesh::Mesh& mesh, const std::vector<double>& coordinates) {
  std::uint64_t hash = 14695981039346656037ull;
  const auto mix = [&hash](std::uint64_t bits) { hash = (hash ^ bits) * 1099511628211ull; };
  for (const double coordinate : coordinates) mix(std::bit_cast<std::uint64_t>(coordinate));
  for (const std::int32_t vertex : mesh.cell_vertices) mix(static_cast<std::uint64_t>(vertex));
  return static_cast<std::int64_t>(hash >> 1);
}

/// Of the parent, and of the meshes that voices have for themselves.
std::vector<std::int64_t> fingerprints(const Scene& scene, Simulation& simulation) {
  std::vector<std::int64_t> result = {fingerprint(scene.parent, scene.parent.coordinates)};
  for (const auto& voice : simulation.voices()) {
    if (voice->has_own_mesh()) result.push_back(fingerprint(voice->mesh(), voice->rest_coordinates()));
  }
  return result;
}

std::vector<double> numbers_of(const ContactReport& report) {
  return {report.searches,          report.closings,           report.closed_steps, report.repeated_steps,
          report.energy_lost,       report.most_closed,        report.seconds_open, report.seconds_closed,
          report.step_seconds_open, report.step_seconds_closed};
}

ContactReport report_of(const std::vector<double>& numbers) {
  return {numbers[0], numbers[1], numbers[2], numbers[3], numbers[4],
          numbers[5], numbers[6], numbers[7], numbers[8], numbers[9]};
}

std::vector<double> on_rank_0(MPI_Comm comm, std::vector<double> values) {
  if (base::rank(comm) != 0) values.clear();
  return values;
}

/// What a checkpoint holds, array by array. All functions are collective.
class Stored {
 public:
  Stored(MPI_Comm comm, const std::string& path) : comm_(comm), path_(path), reader_(comm, path) {}

  /// Rank 0's numbers, on every rank.
  std::vector<double> numbers(const std::string& name) const {
    std::vector<double> values = reader_.doubles(name);
    base::broadcast(comm_, values);
    return values;
  }
  /// This rank's, of whatever size.
  std::vector<double> doubles(const std::string& name) const { return reader_.doubles(name); }

  /// This rank's, into an array that has its size. Throws UserError where that is another one.
  template <class Array>
  void operator()(const std::string& name, Array& values) const {
    const std::vector<double> stored = reader_.doubles(name);
    const bool fits = stored.size() == values.size();
    if (base::smallest(comm_, static_cast<std::int32_t>(fits)) == 0) {
      throw base::UserError("the checkpoint must fit the case: " + path_, name + " has another size",
                            "the case has changed since: run it again");
    }
    values.assign(stored.begin(), stored.end());
  }

  void require_case(const std::string& name) const {
    const std::string written = reader_.text("case");
    if (written == name) return;
    throw base::UserError("the checkpoint must be of this case: " + path_, "of the case \"" + written + "\"",
                          "resume the folder of the run that wrote it");
  }
  void require_mesh(const std::vector<std::int64_t>& prints) const {
    const bool same = reader_.integers("mesh") == prints;
    if (base::smallest(comm_, static_cast<std::int32_t>(same)) == 1) return;
    throw base::UserError("the checkpoint must be of this mesh: " + path_, "another mesh",
                          "the geometry has changed since: run the case again");
  }
  void require_version(bool is_ours, const std::string& words) const {
    if (is_ours) return;
    throw base::UserError("the checkpoint must be of this version of Vocalis: " + path_, "another version's " + words,
                          "run the case again");
  }

 private:
  MPI_Comm comm_;
  std::string path_;
  io::CheckpointReader reader_;
};

CheckpointFacts load_clock(const Stored& stored, Simulation& simulation) {
  const std::vector<double> times = stored.numbers("clock");
  stored.require_version(times.size() == 9, "clock");
  Clock clock = simulation.clock();
  clock.time = times[0];
  clock.step = static_cast<long>(times[1]);
  clock.rejected = static_cast<long>(times[2]);
  clock.halvings = static_cast<int>(times[3]);
  clock.accepted_in_a_row = static_cast<int>(times[4]);
  clock.steps_to_wait = static_cast<int>(times[5]);
  clock.adaptive_step = times[6];
  clock.last_error = times[7];
  simulation.set_clock(clock);
  return {times[8]};
}

void load_flow(const Stored& stored, Simulation& simulation) {
  fsi::State state = simulation.flow()->state();
  const std::vector<double> times = stored.numbers("flow.times");
  state.time = times[0];
  state.last_dt = times[1];
  state.largest_speeds = {times[2], times[3]};
  for_each_flow_array(state, stored);
  simulation.flow()->set_state(state);
  const std::vector<double> balance = stored.numbers("monitors.energy_balance");
  const fsi::KeptEnergy kept = {balance[0], balance[1], balance[2], balance[3]};
  simulation.monitors()->set_balance({kept, balance[4], balance[5], balance[6]});
}

void load_contact(const Stored& stored, ContactFollower& contact) {
  contact::ContactState state = contact.state();
  for_each_contact_array(state, stored);
  contact.set_state(state, report_of(stored.numbers("contact.report")));
}

void load_history(const Stored& stored, Simulation& simulation) {
  const FlowSnapshot newest = simulation.flow_now();
  std::deque<FlowSnapshot> snapshots;
  for (const double time : stored.numbers("history.times")) {
    FlowSnapshot& snapshot = snapshots.emplace_back(newest);
    snapshot.time = time;
    for_each_snapshot_array(snapshot, snapshot_name(snapshots.size() - 1), stored);
  }
  snapshots.push_back(newest);
  simulation.history()->set_snapshots(std::move(snapshots));
  simulation.follow_contact();  // voices' arrays lie on the air of now
}

void load_voice(const Stored& stored, std::size_t number, Voice& voice) {
  acoustic::State state = voice.solver().state();
  const std::vector<double> times = stored.numbers(acoustic_name(number) + ".times");
  stored.require_version(times.size() == 5, "sound");
  state.time = times[0];
  state.has_rates = times[4] != 0;
  if (state.has_rates) state.rates = state;  // for its sizes
  voice.set_rebuilds({static_cast<long>(times[2]), times[3]});
  state.earlier.assign(static_cast<std::size_t>(times[1]), std::vector<double>(state.p.size()));
  for_each_acoustic_array(state, acoustic_name(number), stored);
  voice.solver().set_state(std::move(state));
  const auto memory = voice.analogy().memory();
  for (std::size_t m = 0; m < memory.size(); ++m) *memory[m] = stored.doubles(memory_name(number, m));
  auto& far_fields = voice.microphones().far_fields();
  for (std::size_t f = 0; f < far_fields.size(); ++f) {
    acoustic::FarField::State waiting = far_fields[f].state();
    for_each_far_field_array(waiting, far_field_name(number, f), stored);
    far_fields[f].set_state(std::move(waiting));
  }
}

void load_surfaces(const Stored& stored, SurfaceMicrophones& surfaces) {
  for (std::size_t m = 0; m < surfaces.microphones().size(); ++m) {
    SurfaceMicrophone::State state = surfaces.microphones()[m].state();
    for_each_surface_array(state, surface_name(m), stored);
    surfaces.microphones()[m].set_state(std::move(state));
  }
}

}  // namespace

void save_checkpoint(const std::string& path, const Case& config, const Scene& scene, Simulation& simulation,
                     const CheckpointFacts& facts) {
  const MPI_Comm comm = scene.parent.comm;
  io::CheckpointWriter writer(comm, path);
  const auto add = [&writer](const std::string& name, const auto& values) {
    const std::vector<double> numbers(values.begin(), values.end());
    writer.add(name, std::span<const double>(numbers));
  };
  writer.add_text("case", config.name);
  const std::vector<std::int64_t> mesh = fingerprints(scene, simulation);
  writer.add("mesh", std::span<const std::int64_t>(mesh));
  const Clock& clock = simulation.clock();
  add("clock", on_rank_0(comm, {clock.time, static_cast<double>(clock.step), static_cast<double>(clock.rejected),
                                static_cast<double>(clock.halvings), static_cast<double>(clock.accepted_in_a_row),
                                static_cast<double>(clock.steps_to_wait), clock.adaptive_step, clock.last_error,
                                facts.wall_seconds}));
  if (simulation.flow()) {
    const fsi::State& state = simulation.flow()->state();
    add("flow.times", on_rank_0(comm, {state.time, state.last_dt, state.largest_speeds[0], state.largest_speeds[1]}));
    for_each_flow_array(state, add);
    const fsi::EnergyBalance& balance = simulation.monitors()->balance();
    add("monitors.energy_balance", on_rank_0(comm, {balance.kept.now, balance.kept.slope, balance.kept.curve,
                                                    balance.kept.share, balance.power, balance.dt, balance.work}));
  }
  if (simulation.history()) {
    const auto& snapshots = simulation.history()->snapshots();
    std::vector<double> snapshot_times;
    for (std::size_t n = 0; n + 1 < snapshots.size(); ++n) {
      snapshot_times.push_back(snapshots[n].time);
      for_each_snapshot_array(snapshots[n], snapshot_name(n), add);
    }
    add("history.times", on_rank_0(comm, snapshot_times));
  }
  if (const ContactFollower* contact = simulation.contact()) {
    for_each_contact_array(contact->state(), add);
    add("contact.report", on_rank_0(comm, numbers_of(contact->report())));
  }
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) {
    const acoustic::State& state = simulation.voices()[i]->solver().state();
    const Rebuilds& rebuilds = simulation.voices()[i]->rebuilds();
    add(acoustic_name(i) + ".times",
        on_rank_0(comm, {state.time, static_cast<double>(state.earlier.size()), static_cast<double>(rebuilds.count),
                         rebuilds.energy_lost, static_cast<double>(state.has_rates)}));
    for_each_acoustic_array(state, acoustic_name(i), add);
    const auto memory = simulation.voices()[i]->analogy().memory();
    for (std::size_t m = 0; m < memory.size(); ++m) add(memory_name(i, m), *memory[m]);
    const auto& far_fields = simulation.voices()[i]->microphones().far_fields();
    for (std::size_t f = 0; f < far_fields.size(); ++f) {
      for_each_far_field_array(far_fields[f].state(), far_field_name(i, f), add);
    }
  }
  if (const SurfaceMicrophones* surfaces = simulation.surface_microphones()) {
    for (std::size_t m = 0; m < surfaces->microphones().size(); ++m) {
      for_each_surface_array(surfaces->microphones()[m].state(), surface_name(m), add);
    }
  }
  writer.commit();
}

CheckpointFacts load_checkpoint(const std::string& path, const Case& config, Scene& scene, Simulation& simulation) {
  const Stored stored(scene.parent.comm, path);
  stored.require_case(config.name);
  stored.require_mesh(fingerprints(scene, simulation));
  const CheckpointFacts facts = load_clock(stored, simulation);
  if (simulation.flow()) load_flow(stored, simulation);
  if (ContactFollower* contact = simulation.contact()) load_contact(stored, *contact);
  if (simulation.history()) load_history(stored, simulation);
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) load_voice(stored, i, *simulation.voices()[i]);
  if (SurfaceMicrophones* surfaces = simulation.surface_microphones()) load_surfaces(stored, *surfaces);
  simulation.restart_from_states();
  return facts;
}

}  // namespace vocalis::coupling
