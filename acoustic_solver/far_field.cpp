#include "acoustic_solver/far_field.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "acoustic_solver/surface_images.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"

namespace vocalis::acoustic {

namespace {

using base::UserError;
using Vector = std::array<double, 3>;

// A sample is sent when two later ones are there; an instant is whole when three later samples of the nearest vertex
// were sent, and is heard by way of three later instants; one more for rounding.
constexpr int least_intervals = 10;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

void check_place(MPI_Comm comm, const MicrophoneSettings& microphone, double distance, double solid_angle,
                 double nearest, double longest_edge) {
  const std::string place =
      fmt::format("far-field microphone '{}' hears what comes out of '{}'", microphone.name, microphone.surface);
  if (std::abs(base::sum(comm, solid_angle)) > 2 * std::numbers::pi) {
    throw UserError(place + ", so that it lies outside of that surface", "inside",
                    "write kind = \"mesh\", or move it outwards");
  }
  if (distance >= nearest && distance >= longest_edge) return;
  throw UserError(fmt::format("{}, at least {} intervals of sound ({:.3g} m) and an edge of a facet ({:.3g} m) away",
                              place, least_intervals, nearest, longest_edge),
                  fmt::format("{:.3g} m", distance), "move it outwards, or take a shorter dt of the sound");
}

}  // namespace

FarField::FarField(const mesh::Mesh& mesh, const std::vector<MicrophoneSettings>& microphones,
                   const FarFieldSettings& settings)
    : comm_(mesh.comm),
      settings_(settings),
      surface_(control_surface(mesh, microphones.front().surface, settings.has_source)),
      paths_(microphones.size()) {
  assert(settings.interval > 0);
  check_mirrors(mesh.comm, surface_, microphones);
  check_closed(mesh.comm, surface_, microphones.front());
  for (const std::int32_t v : surface_.skin) {
    skin_points_.insert(skin_points_.end(), mesh.point(v), mesh.point(v) + 3);
  }
  for (double& mass : surface_.mass) mass /= std::pow(settings.speed_of_sound * settings.interval, 2);
  least_delay_ = std::numeric_limits<std::int32_t>::max();
  for (std::size_t m = 0; m < microphones.size(); ++m) add_paths(m, microphones[m]);
  least_delay_ = base::smallest(comm_, least_delay_);
  largest_delay_ = base::largest(comm_, largest_delay_);
  // From the oldest instant that a sample not yet sent may be heard with, to the newest that the next one reaches.
  length_ = static_cast<std::size_t>(largest_delay_ + 2 * least_intervals);
  const std::size_t vertices = surface_.points.size();
  pressure_.resize(vertices), flux_.resize(vertices), inertia_.resize(vertices);
  for (int n = 0; n < six; ++n) state_.clock.push_back((n - 5) * settings.interval);
  state_.clock.push_back(1);
  state_.pressures.assign(six * surface_.skin.size(), 0.0);
  state_.sums.assign(microphones.size() * length_ * six, 0.0);
}

void FarField::add_paths(std::size_t microphone, const MicrophoneSettings& settings) {
  const double step_of_sound = settings_.speed_of_sound * settings_.interval;
  double nearest = std::numeric_limits<double>::infinity(), solid_angle = 0;
  for (const SurfaceImage& image : images(settings.mirrors)) {
    for (std::size_t v = 0; v < surface_.points.size(); ++v) {
      const Vector point = image.of_point(surface_.points[v]), area = image.of_direction(surface_.areas[v]);
      const Vector path = {settings.position[0] - point[0], settings.position[1] - point[1],
                           settings.position[2] - point[2]};
      const double r = std::sqrt(dot(path, path)), delay = std::ceil(r / step_of_sound);
      const double spreading = 1 / (4 * std::numbers::pi * r), along = dot(area, path) / r;
      paths_[microphone].push_back({.vertex = static_cast<std::int32_t>(v),
                                    .delay = static_cast<std::int32_t>(delay),
                                    .fraction = delay - r / step_of_sound,
                                    .monopole = spreading,
                                    .near = along * spreading / r,
                                    .far = along * spreading / step_of_sound});
      nearest = std::min(nearest, r);
      solid_angle += along / (r * r);
      least_delay_ = std::min(least_delay_, paths_[microphone].back().delay);
      largest_delay_ = std::max(largest_delay_, paths_[microphone].back().delay);
    }
  }
  check_place(comm_, settings, base::smallest(comm_, nearest), solid_angle, least_intervals * step_of_sound,
              surface_.longest_edge);
}

void FarField::sample(double time, std::span<const double> vertex_pressure) {
  const std::size_t skin = surface_.skin.size();
  std::rotate(state_.clock.begin(), state_.clock.begin() + 1, state_.clock.begin() + six);
  std::rotate(state_.pressures.begin(), state_.pressures.begin() + skin, state_.pressures.end());
  state_.clock[six - 1] = time;
  for (std::size_t i = 0; i < skin; ++i) state_.pressures[(six - 1) * skin + i] = vertex_pressure[surface_.skin[i]];
  // In the middle of the six samples, where their polynomial is best.
  while (state_.clock[six] * settings_.interval <= state_.clock[3] + 1e-9 * settings_.interval) send();
}

void FarField::send() {
  std::array<double, six> times;
  std::copy_n(state_.clock.begin(), six, times.begin());
  const long number = std::lround(state_.clock[six]);
  const auto weights = six_point_weights(times, static_cast<double>(number) * settings_.interval);
  const std::size_t skin = surface_.skin.size();
  std::vector<double> p(skin, 0.0);
  for (int n = 0; n < six; ++n) {
    for (std::size_t i = 0; i < skin; ++i) p[i] += weights[n] * state_.pressures[n * skin + i];
  }
  for (std::size_t v = 0; v < surface_.points.size(); ++v) {
    pressure_[v] = p[surface_.vertex_in_skin[v]];
    flux_[v] = inertia_[v] = 0;
    for (std::int32_t e = surface_.row_begin[v]; e < surface_.row_begin[v + 1]; ++e) {
      flux_[v] -= surface_.stiffness[e] * p[surface_.columns[e]];
      inertia_[v] -= surface_.mass[e] * p[surface_.columns[e]];
    }
  }
  for (std::size_t m = 0; m < paths_.size(); ++m) {
    std::fill_n(state_.sums.begin() + static_cast<std::ptrdiff_t>(sums_of(m, number + largest_delay_)), six, 0.0);
    for (const Path& path : paths_[m]) {
      // value v(f) + rate v'(f) + second v''(f) of the polynomial v at f, by powers of f.
      const double f = path.fraction, rate = path.far * pressure_[path.vertex];
      const double value = path.monopole * flux_[path.vertex] + path.near * pressure_[path.vertex];
      const double second = path.monopole * inertia_[path.vertex];
      double* sum = state_.sums.data() + sums_of(m, number + path.delay);
      const double f2 = f * f, f3 = f2 * f;
      sum[0] += value;
      sum[1] += value * f + rate;
      sum[2] += value * f2 + 2 * rate * f + 2 * second;
      sum[3] += value * f3 + 3 * rate * f2 + 6 * second * f;
      sum[4] += value * f2 * f2 + 4 * rate * f3 + 12 * second * f2;
      sum[5] += value * f2 * f3 + 5 * rate * f2 * f2 + 20 * second * f3;
    }
  }
  ++state_.clock[six];
}

double FarField::pressure(std::size_t microphone, double time) const {
  const double place = time / settings_.interval;
  // Instants that all samples needed were sent for; that is more than asked for unless samples have become rare.
  const long whole = std::lround(state_.clock[six]) - 1 + least_delay_ - 3;
  const long middle = std::min(static_cast<long>(std::floor(place)), whole - 3);
  std::array<double, six> nodes;
  for (int n = 0; n < six; ++n) nodes[n] = n - 2;
  const auto weights = six_point_weights(nodes, place - static_cast<double>(middle));
  const auto& powers = six_point_powers();
  double result = 0;
  for (int n = 0; n < six; ++n) {
    const long instant = middle + n - 2;
    if (instant < 3) continue;  // nothing was heard yet: see `least_intervals`
    for (int i = 0; i < six; ++i) {
      const double* sum = state_.sums.data() + sums_of(microphone, instant + i - 2);
      for (int power = 0; power < six; ++power) result += weights[n] * powers[i][power] * sum[power];
    }
  }
  return result;
}

void FarField::require_still(const mesh::Mesh& mesh, std::span<const double> coordinates) const {
  double moved = 0;
  for (std::size_t i = 0; i < surface_.skin.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const double now = coordinates[static_cast<std::size_t>(surface_.skin[i]) * 3 + k];
      moved = std::max(moved, std::abs(now - skin_points_[3 * i + k]));
    }
  }
  moved = base::largest(mesh.comm, moved);
  if (moved <= 1e-9 * surface_.longest_edge) return;
  throw UserError("the surface of a far-field microphone stands still", fmt::format("it moved by {:.3g} m", moved),
                  "choose a surface in the air that does not follow the folds");
}

void FarField::renumber(std::span<const std::int32_t> vertex_there) {
  for (std::int32_t& v : surface_.skin) {
    v = vertex_there[v];
    assert(v >= 0);
  }
}

void FarField::set_state(State state) {
  assert(state.clock.size() == state_.clock.size() && state.pressures.size() == state_.pressures.size() &&
         state.sums.size() == state_.sums.size());
  state_ = std::move(state);
}

}  // namespace vocalis::acoustic
