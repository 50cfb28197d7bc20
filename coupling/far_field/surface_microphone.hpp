#pragma once

#include <memory>
#include <vector>

#include "acoustic_solver/surface_images.hpp"
#include "coupling/far_field/flow_surface.hpp"
#include "coupling/far_field/listening_point.hpp"

namespace vocalis::coupling {

/// When sound of a surface is sent and heard.
struct SoundClock {
  double interval = 0;  ///< [s] of equally spaced instants: the case's step
  double end = 0;       ///< [s] of the run
};

/// A microphone outside of all meshes: what a surface of the flow gives off, and how it is heard there. The flow is at
/// rest before time 0, and linear in time between its steps.
class SurfaceMicrophone {
 public:
  /// All that later pressures depend on, on this rank.
  struct State {
    std::vector<double> clock;      ///< time of the last snapshot [s], the next instant's number
    std::vector<double> emissions;  ///< (sources, 4) of that snapshot
    std::vector<double> sums;       ///< see `ListeningPoint::sums`
  };

  /// The mesh is the flow's at rest, and must outlive this. Throws UserError: what `FlowSurface` does not take; an open
  /// surface (only Curle's may be open); one that passes a mirror; one of Ffowcs Williams and Hawkings around the whole
  /// flow; a microphone inside of it, behind a mirror, or too near. Collective.
  ///
  /// cell_is_fluid  (local cells, ghosts too)
  SurfaceMicrophone(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_is_fluid, const FlowMaterial& material,
                    const SurfaceMicrophoneSettings& settings, const SoundClock& clock);

  /// Listens to one accepted step of the flow; returns this rank's part of the pressure at its end [Pa]. Not
  /// collective.
  double follow(const FlowSnapshot& before, const FlowSnapshot& flow);

  State state() const;
  void set_state(State state);

 private:
  std::vector<Emission> sources(const FlowSnapshot& before, const FlowSnapshot& flow) const;

  SoundClock clock_;
  FlowSurface surface_;
  std::vector<acoustic::SurfaceImage> images_;
  bool compact_;
  std::unique_ptr<ListeningPoint> point_;
  State state_;  ///< without the sums, which `point_` has
};

}  // namespace vocalis::coupling
