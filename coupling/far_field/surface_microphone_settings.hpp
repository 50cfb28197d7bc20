#pragma once

#include <array>
#include <string>
#include <vector>

#include "acoustic_solver/settings.hpp"

namespace vocalis::coupling {

/// What the sound of a surface in the flow is made of.
enum class SurfaceMethod {
  curle,                     ///< the force of solid walls on the flow (Curle 1955)
  ffowcs_williams_hawkings,  ///< that, and what passes a surface that lets the flow through (1969)
};

/// A microphone outside of all meshes, which hears a surface of the flow mesh.
struct SurfaceMicrophoneSettings {
  std::string name;
  std::array<double, 3> position = {0, 0, 0};  ///< [m]
  SurfaceMethod method = SurfaceMethod::curle;
  std::vector<std::string> groups;             ///< of facets, which make the surface
  bool compact = false;                        ///< all of it sounds from its middle
  bool viscous_stress = true;                  ///< counts beside the pressure
  double speed_of_sound = 350;                 ///< c [m/s]
  std::vector<acoustic::MirrorPlane> mirrors;  ///< that the surface ends at, of different axes
};

}  // namespace vocalis::coupling
