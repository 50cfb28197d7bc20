#pragma once

#include <cstddef>
#include <string>

namespace vocalis::coupling {

// The arrays of a checkpoint: each calls function(name, array) for all arrays of a state.

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

/// What far-field microphones of a voice are still to hear; the names end in the number of the surface.
template <class State, class Function>
void for_each_far_field_array(State& state, const std::string& name, const Function& function) {
  function(name + ".clock", state.clock);
  function(name + ".pressures", state.pressures);
  function(name + ".sums", state.sums);
}

inline std::string far_field_name(std::size_t voice, std::size_t surface) {
  return "acoustic" + std::to_string(voice) + ".far_field" + std::to_string(surface);
}

inline std::string memory_name(std::size_t voice, std::size_t index) {
  return "acoustic" + std::to_string(voice) + ".memory" + std::to_string(index);
}

/// What microphones of surfaces are still to hear; the names end in the number of the microphone.
template <class State, class Function>
void for_each_surface_array(State&& state, const std::string& name, const Function& function) {
  function(name + ".clock", state.clock);
  function(name + ".emissions", state.emissions);
  function(name + ".sums", state.sums);
}

inline std::string surface_name(std::size_t microphone) { return "surface_microphone" + std::to_string(microphone); }

/// Snapshots of the flow that derivatives over several steps still need, without the newest, which is the flow's state.
template <class Snapshot, class Function>
void for_each_snapshot_array(Snapshot& snapshot, const std::string& name, const Function& function) {
  function(name + ".pressure", snapshot.pressure);
  function(name + ".velocity", snapshot.velocity);
  function(name + ".velocity_of_edges", snapshot.velocity_of_edges);
  function(name + ".displacement", snapshot.displacement);
  function(name + ".in_contact", snapshot.in_contact);
}

inline std::string snapshot_name(std::size_t index) { return "history" + std::to_string(index); }

inline std::string acoustic_name(std::size_t index) { return "acoustic" + std::to_string(index); }

}  // namespace vocalis::coupling
