#pragma once

#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/far_field.hpp"
#include "acoustic_solver/settings.hpp"
#include "core/mesh/locate.hpp"

namespace vocalis::acoustic {

/// The pressure p_ic of an incompressible flow, as microphones hear it.
struct FlowPressure {
  std::span<const double> vertex_values;        ///< (vertices) [Pa]; what counts are those of cells with flow
  std::span<const std::int32_t> cell_has_flow;  ///< (owned cells)
};

/// Points that listen, on the mesh and outside of it. The rank that holds a microphone's cell interpolates, of a
/// far-field microphone each rank has a part; samples stay on the ranks and meet on rank 0 in blocks, since a message a
/// sub-step would cost more than the sound.
class Microphones {
 public:
  /// Samples since the last `collect`: with those of `far_fields` part of a checkpoint.
  struct State {
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< (samples, microphones) this rank's part of p_a
    std::vector<double> flow;    ///< (samples, microphones) this rank's part of p_ic; empty without a flow
  };
  /// Samples of all microphones, on rank 0.
  struct Block {
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< (samples, microphones) p_a [Pa]
    std::vector<double> flow;    ///< (samples, microphones) p_ic [Pa], 0 where there is no flow; empty without a flow
  };

  /// `air` counts where there are far-field microphones. Throws UserError for a far field that cannot be, see
  /// `FarField`. Collective.
  Microphones(const mesh::Mesh& mesh, std::vector<MicrophoneSettings> settings, const FarFieldSettings& air = {});

  /// Names of the microphones on the mesh that no cell contains; they record silence. The same on every rank.
  std::vector<std::string> outside() const;
  /// Throws UserError if a microphone on the mesh lies outside of it.
  void require_inside() const;
  /// Whether each microphone is in a cell with flow, on every rank. Collective.
  std::vector<std::int32_t> in_flow(std::span<const std::int32_t> cell_has_flow) const;

  /// Samples a P1 function, (vertices) ghosts current, and the flow's pressure: always, or never. Not collective.
  void sample(double time, std::span<const double> vertex_values, const FlowPressure* flow = nullptr);

  /// To be called when the mesh moved or is another one: weights follow the cells at the mesh's present coordinates,
  /// and a microphone that its cell has left behind finds its new one. Surfaces of far fields stay. Collective.
  void follow(const mesh::Mesh& mesh, bool is_other_mesh = false);

  /// Goes on with another mesh, which has all cells along the surfaces of far fields. A microphone that none of its
  /// cells contains records silence. Collective.
  ///
  /// vertex_there  (vertices of the mesh before) the number there, or -1
  void adopt(const mesh::Mesh& mesh, std::span<const std::int32_t> vertex_there);

  /// The samples since the last time, on rank 0; on the others empty. Collective.
  Block collect();

  const std::vector<MicrophoneSettings>& settings() const { return settings_; }
  const State& state() const { return state_; }
  void set_state(State state) { state_ = std::move(state); }
  /// One for each surface with its mirrors.
  std::vector<FarField>& far_fields() { return far_fields_; }
  const std::vector<FarField>& far_fields() const { return far_fields_; }

 private:
  void add_far_fields(const FarFieldSettings& air);

  const mesh::Mesh* mesh_;
  std::vector<MicrophoneSettings> settings_;
  std::vector<mesh::Location> locations_;
  std::vector<FarField> far_fields_;
  std::vector<std::array<std::size_t, 2>> far_place_;  ///< (microphones) far field, number in it; of far-field ones
  State state_;
};

}  // namespace vocalis::acoustic
