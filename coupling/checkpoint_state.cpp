#include "coupling/checkpoint_state.hpp"

#include <bit>
#include <cstring>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/io/checkpoint.hpp"

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

/// The arrays of the flow, by name.
template <class State, class Function>
void for_each_flow_array(State& state, const Function& function) {
  function("flow.velocity", state.velocity.values);
  function("flow.velocity_before", state.velocity_before.values);
  function("flow.displacement", state.displacement.values);
  function("flow.displacement_before", state.displacement_before.values);
  function("flow.acceleration", state.acceleration.values);
  function("flow.pressure", state.pressure.values);
  function("flow.closing_points", state.closing_points);
  function("flow.contact_normals", state.contact_normals);
  function("flow.mesh_offset", state.mesh_offset);
  function("flow.in_contact", state.in_contact);
}

/// Which cells are to be in contact in the next step, and what is remembered of them.
template <class State, class Function>
void for_each_contact_array(State& state, const Function& function) {
  function("contact.closing_gap", state.closing_gap);
  function("contact.opening_gap", state.opening_gap);
  function("contact.normal", state.normal);
  function("contact.in_contact", state.in_contact);
}

template <class Unknowns, class Function>
void for_each_array_of_sound(Unknowns& unknowns, const std::string& name, const Function& function) {
  function(name + ".p", unknowns.p);
  function(name + ".psi", unknowns.psi);
  function(name + ".layer_flux", unknowns.layer_flux);
  function(name + ".layer_integral", unknowns.layer_integral);
  function(name + ".wall_motion", unknowns.wall_motion);
}

template <class State, class Function>
void for_each_acoustic_array(State& state, const std::string& name, const Function& function) {
  for_each_array_of_sound(state, name, function);
  for_each_array_of_sound(state.rates, name + ".rates", function);
  for (std::size_t i = 0; i < state.earlier.size(); ++i)
    function(name + ".earlier" + std::to_string(i), state.earlier[i]);
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

/// What far-field microphones of a voice are still to hear; the names end in the number of the surface.
template <class State, class Function>
void for_each_far_field_array(State& state, const std::string& name, const Function& function) {
  function(name + ".clock", state.clock);
  function(name + ".pressures", state.pressures);
  function(name + ".sums", state.sums);
}

std::string far_field_name(std::size_t voice, std::size_t surface) {
  return "acoustic" + std::to_string(voice) + ".far_field" + std::to_string(surface);
}

std::string memory_name(std::size_t voice, std::size_t index) {
  return "acoustic" + std::to_string(voice) + ".memory" + std::to_string(index);
}

/// What microphones of surfaces are still to hear; the names end in the number of the microphone.
template <class State, class Function>
void for_each_surface_array(State&& state, const std::string& name, const Function& function) {
  function(name + ".clock", state.clock);
  function(name + ".emissions", state.emissions);
  function(name + ".sums", state.sums);
}

std::string surface_name(std::size_t microphone) { return "surface_microphone" + std::to_string(microphone); }

std::vector<double> on_rank_0(MPI_Comm comm, std::vector<double> values) {
  if (base::rank(comm) != 0) values.clear();
  return values;
}

/// Snapshots of the flow that derivatives over several steps still need, without the newest, which is the flow's state.
template <class Snapshot, class Function>
void for_each_snapshot_array(Snapshot& snapshot, const std::string& name, const Function& function) {
  function(name + ".pressure", snapshot.pressure);
  function(name + ".velocity", snapshot.velocity);
  function(name + ".velocity_of_edges", snapshot.velocity_of_edges);
  function(name + ".displacement", snapshot.displacement);
  function(name + ".in_contact", snapshot.in_contact);
}

std::string snapshot_name(std::size_t index) { return "history" + std::to_string(index); }

std::string acoustic_name(std::size_t index) { return "acoustic" + std::to_string(index); }

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
    const EnergyBalance& balance = simulation.monitors()->balance();
    add("monitors.balance", on_rank_0(comm, {balance.time, balance.power, balance.work}));
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
  const MPI_Comm comm = scene.parent.comm;
  const io::CheckpointReader reader(comm, path);
  if (const std::string name = reader.text("case"); name != config.name) {
    throw base::UserError("the checkpoint must be of this case: " + path, "of the case \"" + name + "\"",
                          "resume the folder of the run that wrote it");
  }
  const bool same = reader.integers("mesh") == fingerprints(scene, simulation);
  if (base::smallest(comm, static_cast<std::int32_t>(same)) == 0) {
    throw base::UserError("the checkpoint must be of this mesh: " + path, "another mesh",
                          "the geometry has changed since: run the case again");
  }
  const auto numbers = [&](const std::string& name) {
    std::vector<double> values = reader.doubles(name);
    base::broadcast(comm, values);
    return values;
  };
  const auto read = [&](const std::string& name, auto& values) {
    const std::vector<double> stored = reader.doubles(name);
    const bool fits = stored.size() == values.size();
    if (base::smallest(comm, static_cast<std::int32_t>(fits)) == 0) {
      throw base::UserError("the checkpoint must fit the case: " + path, name + " has another size",
                            "the case has changed since: run it again");
    }
    values.assign(stored.begin(), stored.end());
  };
  const std::vector<double> times = numbers("clock");
  const auto require_version = [&path](bool is_ours, const std::string& words) {
    if (is_ours) return;
    throw base::UserError("the checkpoint must be of this version of Vocalis: " + path, "another version's " + words,
                          "run the case again");
  };
  require_version(times.size() == 9, "clock");
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
  if (simulation.flow()) {
    fsi::State state = simulation.flow()->state();
    const std::vector<double> flow_times = numbers("flow.times");
    state.time = flow_times[0];
    state.last_dt = flow_times[1];
    state.largest_speeds = {flow_times[2], flow_times[3]};
    for_each_flow_array(state, read);
    simulation.flow()->set_state(state);
    const std::vector<double> balance = numbers("monitors.balance");
    simulation.monitors()->set_balance({balance[0], balance[1], balance[2]});
  }
  if (ContactFollower* contact = simulation.contact()) {
    contact::ContactState state = contact->state();
    for_each_contact_array(state, read);
    contact->set_state(state, report_of(numbers("contact.report")));
  }
  if (simulation.history()) {
    const FlowSnapshot newest = simulation.flow_now();
    std::deque<FlowSnapshot> snapshots;
    for (const double time : numbers("history.times")) {
      FlowSnapshot& snapshot = snapshots.emplace_back(newest);
      snapshot.time = time;
      for_each_snapshot_array(snapshot, snapshot_name(snapshots.size() - 1), read);
    }
    snapshots.push_back(newest);
    simulation.history()->set_snapshots(std::move(snapshots));
    simulation.follow_contact();  // voices' arrays lie on the air of now
  }
  for (std::size_t i = 0; i < simulation.voices().size(); ++i) {
    acoustic::State state = simulation.voices()[i]->solver().state();
    const std::vector<double> acoustic_times = numbers(acoustic_name(i) + ".times");
    require_version(acoustic_times.size() == 5, "sound");
    state.time = acoustic_times[0];
    state.has_rates = acoustic_times[4] != 0;
    if (state.has_rates) state.rates = state;  // for its sizes
    simulation.voices()[i]->set_rebuilds({static_cast<long>(acoustic_times[2]), acoustic_times[3]});
    state.earlier.assign(static_cast<std::size_t>(acoustic_times[1]), std::vector<double>(state.p.size()));
    for_each_acoustic_array(state, acoustic_name(i), read);
    simulation.voices()[i]->solver().set_state(std::move(state));
    const auto memory = simulation.voices()[i]->analogy().memory();
    for (std::size_t m = 0; m < memory.size(); ++m) *memory[m] = reader.doubles(memory_name(i, m));
    auto& far_fields = simulation.voices()[i]->microphones().far_fields();
    for (std::size_t f = 0; f < far_fields.size(); ++f) {
      acoustic::FarField::State waiting = far_fields[f].state();
      for_each_far_field_array(waiting, far_field_name(i, f), read);
      far_fields[f].set_state(std::move(waiting));
    }
  }
  if (SurfaceMicrophones* surfaces = simulation.surface_microphones()) {
    for (std::size_t m = 0; m < surfaces->microphones().size(); ++m) {
      SurfaceMicrophone::State state = surfaces->microphones()[m].state();
      for_each_surface_array(state, surface_name(m), read);
      surfaces->microphones()[m].set_state(std::move(state));
    }
  }
  simulation.restart_from_states();
  return {times[8]};
}

}  // namespace vocalis::coupling
