#pragma once

#include <mpi.h>

#include <array>
#include <vector>

#include "acoustic_solver/control_surface.hpp"
#include "acoustic_solver/settings.hpp"

namespace vocalis::acoustic {

/// The surface itself, or what some of the mirrors together make of it.
struct SurfaceImage {
  std::array<double, 3> scale = {1, 1, 1}, shift = {0, 0, 0};  ///< point -> scale point + shift [m]

  std::array<double, 3> of_point(const std::array<double, 3>& point) const;
  std::array<double, 3> of_direction(const std::array<double, 3>& direction) const;
};

/// The surface and its images in the mirrors and their intersections: 1, 2, 4 or 8.
std::vector<SurfaceImage> images(const std::vector<MirrorPlane>& mirrors);

/// Throws UserError on every rank if the surface passes one of the mirrors, or if a microphone is behind one. All
/// microphones have the same surface and mirrors. Collective.
void check_mirrors(MPI_Comm comm, const ControlSurface& surface, const std::vector<MicrophoneSettings>& microphones);

/// Throws UserError on every rank if the surface and its images leave an opening. Collective.
void check_closed(MPI_Comm comm, const ControlSurface& surface, const MicrophoneSettings& microphone);

}  // namespace vocalis::acoustic
