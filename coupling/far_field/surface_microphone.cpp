#include "coupling/far_field/surface_microphone.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::coupling {

namespace {

using acoustic::SurfaceImage;
using base::UserError;
using fem::Point;

constexpr int numbers_of_emission = 4;
constexpr double rounding = 1e-9;    // of an interval
constexpr double least_angle = 0.5;  // of all directions: so much of them a surface fills from its inside

double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Point path(const Point& from, const std::array<double, 3>& to) {
  return {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
}

/// What a surface with its images is, seen from a microphone. Sums over all ranks.
struct Look {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;  ///< [m]
  double directions = 0;  ///< share of all that it fills, 1 inside and 0 outside if closed; < 0: seen from outside
  double volume = 0;      ///< within, if closed [m^3]
};

Look look_at(MPI_Comm comm, int dimension, const FlowSurface& surface, const std::vector<SurfaceImage>& images,
             const std::array<double, 3>& position) {
  Look look;
  for (const SurfaceImage& image : images) {
    for (std::size_t i = 0; i < surface.size(); ++i) {
      const Point middle = image.of_point(surface.middles()[i]), area = image.of_direction(surface.areas()[i]);
      const Point way = path(middle, position);
      const double r = std::sqrt(dot(way, way));
      look.nearest = std::min(look.nearest, r);
      look.farthest = std::max(look.farthest, r);
      look.directions -= dot(area, way) / std::pow(r, dimension);
      look.volume += dot(area, middle) / dimension;
    }
  }
  look.nearest = base::smallest(comm, look.nearest);
  look.farthest = base::largest(comm, look.farthest);
  look.directions = base::sum(comm, look.directions) / (2 * (dimension - 1) * std::numbers::pi);
  look.volume = base::sum(comm, look.volume);
  return look;
}

/// Throws UserError for a surface that the method or the mirrors do not allow. Collective.
void check_shape(MPI_Comm comm, const FlowSurface& surface, const SurfaceMicrophoneSettings& settings,
                 const Look& look) {
  acoustic::MicrophoneSettings microphone = {.name = settings.name, .position = settings.position};
  microphone.surface = fmt::format("{}", fmt::join(settings.groups, ", "));
  microphone.mirrors = settings.mirrors;
  acoustic::ControlSurface shape;
  shape.points = surface.middles();
  shape.areas = surface.areas();
  shape.longest_edge = surface.longest_edge();
  acoustic::check_mirrors(comm, shape, {microphone});
  if (settings.method != SurfaceMethod::curle) acoustic::check_closed(comm, shape, microphone);
  if (settings.method != SurfaceMethod::curle && look.volume < 0) {
    throw UserError(fmt::format("the surface of microphone '{}' is around what makes the sound", settings.name),
                    fmt::format("\"{}\" with the flow inside", microphone.surface),
                    "name walls of a body in the flow, or a closed surface inside the flow");
  }
  if (std::abs(look.directions) < least_angle) return;
  throw UserError(fmt::format("microphone '{}' lies outside of the surface that it hears", settings.name), "inside",
                  "move it outwards");
}

void check_distance(const SurfaceMicrophoneSettings& settings, double nearest, double step_of_sound,
                    double longest_edge) {
  const double least = ListeningPoint::least_intervals * step_of_sound;
  if (nearest >= least && (settings.compact || nearest >= longest_edge)) return;
  throw UserError(fmt::format("microphone '{}' is {} time steps of sound ({:.3g} m) and an edge of a facet ({:.3g} m) "
                              "or more away from what it hears",
                              settings.name, ListeningPoint::least_intervals, least, longest_edge),
                  fmt::format("{:.3g} m", nearest), "move it outwards, or take a shorter time.dt");
}

/// The middle of the facets of all ranks, by their areas. Collective.
Point centre(MPI_Comm comm, const FlowSurface& surface) {
  std::array<double, 4> sums = {0, 0, 0, 0};
  for (std::size_t i = 0; i < surface.size(); ++i) {
    const double area = std::sqrt(dot(surface.areas()[i], surface.areas()[i]));
    for (int k = 0; k < 3; ++k) sums[k] += area * surface.middles()[i][k];
    sums[3] += area;
  }
  for (double& sum : sums) sum = base::sum(comm, sum);
  return {sums[0] / sums[3], sums[1] / sums[3], sums[2] / sums[3]};
}

}  // namespace

SurfaceMicrophone::SurfaceMicrophone(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_is_fluid,
                                     const FlowMaterial& material, const SurfaceMicrophoneSettings& settings,
                                     const SoundClock& clock)
    : clock_(clock),
      surface_(mesh, cell_is_fluid, material, settings),
      images_(acoustic::images(settings.mirrors)),
      compact_(settings.compact) {
  Look look = look_at(mesh.comm, mesh.dimension, surface_, images_, settings.position);
  check_shape(mesh.comm, surface_, settings, look);
  std::vector<Point> sources = surface_.middles();
  if (compact_) sources = {centre(mesh.comm, surface_)};
  std::vector<Point> points;
  for (const SurfaceImage& image : images_) {
    for (const Point& source : sources) points.push_back(image.of_point(source));
  }
  if (compact_) {
    look.nearest = std::numeric_limits<double>::infinity(), look.farthest = 0;
    for (const Point& point : points) {
      const Point way = path(point, settings.position);
      look.nearest = std::min(look.nearest, std::sqrt(dot(way, way)));
      look.farthest = std::max(look.farthest, std::sqrt(dot(way, way)));
    }
  }
  check_distance(settings, look.nearest, settings.speed_of_sound * clock.interval, surface_.longest_edge());
  const ListeningSettings listening = {.dimension = mesh.dimension,
                                       .speed_of_sound = settings.speed_of_sound,
                                       .interval = clock.interval,
                                       .end = clock.end,
                                       .hears_mass = settings.method != SurfaceMethod::curle};
  point_ = std::make_unique<ListeningPoint>(listening, settings.position, points,
                                            std::array<double, 2>{look.nearest, look.farthest});
  state_.clock = {0, 1};
  state_.emissions.assign(points.size() * numbers_of_emission, 0.0);
}

std::vector<Emission> SurfaceMicrophone::sources(const FlowSnapshot& before, const FlowSnapshot& flow) const {
  std::vector<Emission> pieces = surface_.emissions(before, flow);
  if (compact_) {
    Emission whole;
    for (const Emission& piece : pieces) {
      for (int k = 0; k < 3; ++k) whole.force[k] += piece.force[k];
      whole.mass_rate += piece.mass_rate;
    }
    pieces = {whole};
  }
  std::vector<Emission> result;
  for (const SurfaceImage& image : images_) {
    for (const Emission& piece : pieces) result.push_back({image.of_direction(piece.force), piece.mass_rate});
  }
  return result;
}

double SurfaceMicrophone::follow(const FlowSnapshot& before, const FlowSnapshot& flow) {
  const std::vector<Emission> now = sources(before, flow);
  std::vector<Emission> between(now.size());
  double& last = state_.clock[0];
  double& number = state_.clock[1];
  for (; number * clock_.interval <= flow.time + rounding * clock_.interval; ++number) {
    const double part = (number * clock_.interval - last) / (flow.time - last);
    for (std::size_t i = 0; i < now.size(); ++i) {
      const double* then = state_.emissions.data() + i * numbers_of_emission;
      for (int k = 0; k < 3; ++k) between[i].force[k] = (1 - part) * then[k] + part * now[i].force[k];
      between[i].mass_rate = (1 - part) * then[3] + part * now[i].mass_rate;
    }
    point_->send(std::lround(number), between);
  }
  last = flow.time;
  for (std::size_t i = 0; i < now.size(); ++i) {
    std::copy_n(now[i].force.begin(), 3,
                state_.emissions.begin() + static_cast<std::ptrdiff_t>(i) * numbers_of_emission);
    state_.emissions[i * numbers_of_emission + 3] = now[i].mass_rate;
  }
  return point_->pressure(flow.time);
}

SurfaceMicrophone::State SurfaceMicrophone::state() const {
  State state = state_;
  state.sums = point_->sums();
  return state;
}

void SurfaceMicrophone::set_state(State state) {
  assert(state.clock.size() == state_.clock.size() && state.emissions.size() == state_.emissions.size());
  point_->set_sums(std::move(state.sums));
  state.sums.clear();
  state_ = std::move(state);
}

}  // namespace vocalis::coupling
