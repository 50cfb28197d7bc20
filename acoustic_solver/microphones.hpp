#pragma once

#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/settings.hpp"
#include "core/mesh/locate.hpp"

namespace vocalis::acoustic {

/// Points that listen. The rank that holds a microphone's cell interpolates; samples stay on the ranks and meet on
/// rank 0 in blocks, since a message a sub-step would cost more than the sound.
class Microphones {
 public:
  /// Samples since the last `collect`: part of a checkpoint.
  struct State {
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< (samples, microphones); 0 where another rank has the microphone
  };
  /// Samples of all microphones, on rank 0.
  struct Block {
    std::vector<double> times;   ///< [s]
    std::vector<double> values;  ///< (samples, microphones)
  };

  /// Collective.
  Microphones(const mesh::Mesh& mesh, std::vector<MicrophoneSettings> settings);

  /// Names of the microphones that no cell contains; they record silence. The same on every rank.
  std::vector<std::string> outside() const;
  /// Throws UserError if a microphone lies outside of the mesh.
  void require_inside() const;

  /// Samples a P1 function, (vertices) ghosts current. Not collective.
  void sample(double time, std::span<const double> vertex_values);

  /// To be called when the mesh moved or is another one: weights follow the cells at the mesh's present coordinates,
  /// and a microphone that its cell has left behind finds its new one. Collective.
  void follow(const mesh::Mesh& mesh, bool is_other_mesh = false);

  /// The samples since the last time, on rank 0; on the others empty. Collective.
  Block collect();

  std::size_t num_samples() const { return state_.times.size(); }
  const std::vector<MicrophoneSettings>& settings() const { return settings_; }
  const State& state() const { return state_; }
  void set_state(State state) { state_ = std::move(state); }

 private:
  const mesh::Mesh* mesh_;
  std::vector<MicrophoneSettings> settings_;
  std::vector<mesh::Location> locations_;
  State state_;
};

}  // namespace vocalis::acoustic
