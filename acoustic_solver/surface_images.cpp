#include "acoustic_solver/surface_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

using base::UserError;

constexpr double rounding = 1e-6;  // of an edge, or of the surface's area

void check_sides(MPI_Comm comm, const ControlSurface& surface, const MirrorPlane& mirror,
                 const std::vector<MicrophoneSettings>& microphones) {
  double lowest = 0, highest = 0, facing = 0;
  for (std::size_t v = 0; v < surface.points.size(); ++v) {
    lowest = std::min(lowest, surface.points[v][mirror.axis] - mirror.position);
    highest = std::max(highest, surface.points[v][mirror.axis] - mirror.position);
    facing += surface.areas[v][mirror.axis];
  }
  lowest = base::smallest(comm, lowest);
  highest = base::largest(comm, highest);
  facing = base::sum(comm, facing);
  const double tolerance = rounding * surface.longest_edge;
  const std::string plane = fmt::format("{} = {:g} m", "xyz"[mirror.axis], mirror.position);
  if (lowest < -tolerance && highest > tolerance) {
    throw UserError("a surface lies on one side of its mirror " + plane,
                    fmt::format("from {:.3g} m to {:.3g} m of it", lowest, highest),
                    "set mirror_at to where the baffle is");
  }
  // A surface in the plane of the mirror sends to where its normal points.
  const bool is_flat = lowest >= -tolerance && highest <= tolerance;
  const double side = is_flat ? facing : lowest + highest;
  for (const MicrophoneSettings& microphone : microphones) {
    const double ahead = (microphone.position[mirror.axis] - mirror.position) * (side > 0 ? 1 : -1);
    if (ahead >= -tolerance) continue;
    throw UserError(
        fmt::format("far-field microphone '{}' is on the sound's side of the mirror {}", microphone.name, plane),
        fmt::format("{:.3g} m behind it", -ahead), "move it to the other side: the sound there is the same");
  }
}

}  // namespace

std::array<double, 3> SurfaceImage::of_point(const std::array<double, 3>& point) const {
  return {scale[0] * point[0] + shift[0], scale[1] * point[1] + shift[1], scale[2] * point[2] + shift[2]};
}

std::array<double, 3> SurfaceImage::of_direction(const std::array<double, 3>& direction) const {
  return {scale[0] * direction[0], scale[1] * direction[1], scale[2] * direction[2]};
}

std::vector<SurfaceImage> images(const std::vector<MirrorPlane>& mirrors) {
  std::vector<SurfaceImage> result(1);
  for (const MirrorPlane& mirror : mirrors) {
    for (std::size_t i = 0, count = result.size(); i < count; ++i) {
      SurfaceImage image = result[i];
      image.scale[mirror.axis] = -1;
      image.shift[mirror.axis] = 2 * mirror.position;
      result.push_back(image);
    }
  }
  return result;
}

void check_mirrors(MPI_Comm comm, const ControlSurface& surface, const std::vector<MicrophoneSettings>& microphones) {
  for (const MirrorPlane& mirror : microphones.front().mirrors) check_sides(comm, surface, mirror, microphones);
}

void check_closed(MPI_Comm comm, const ControlSurface& surface, const MicrophoneSettings& microphone) {
  std::array<double, 3> sum = {0, 0, 0};
  double whole = 0;
  for (const SurfaceImage& image : images(microphone.mirrors)) {
    for (const auto& area : surface.areas) {
      const auto there = image.of_direction(area);
      for (int k = 0; k < 3; ++k) sum[k] += there[k];
      whole += std::hypot(area[0], area[1], area[2]);
    }
  }
  for (double& component : sum) component = base::sum(comm, component);
  whole = base::sum(comm, whole);
  const double opening = std::hypot(sum[0], sum[1], sum[2]);
  if (opening <= rounding * whole) return;
  throw UserError(
      fmt::format("the surface '{}' of a far-field microphone is closed, or closed by its mirror images",
                  microphone.surface),
      fmt::format("an opening of {:.3g} m^2, whose normal is ({:.3g}, {:.3g}, {:.3g})", opening, sum[0] / opening,
                  sum[1] / opening, sum[2] / opening),
      "set mirror and mirror_at to the plane of the baffle (or of symmetry) that the surface ends at, or close it");
}

}  // namespace vocalis::acoustic
