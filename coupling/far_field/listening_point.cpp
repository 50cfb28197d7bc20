#include "coupling/far_field/listening_point.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "coupling/far_field/plane_response.hpp"

namespace vocalis::coupling {

namespace {

// In space: what a rate is taken of, and what counts as it is.
constexpr std::size_t rated = 0, plain = 1, series_in_space = 2;
constexpr double rounding = 1e-9;  // of an interval

}  // namespace

ListeningPoint::ListeningPoint(const ListeningSettings& settings, const std::array<double, 3>& position,
                               std::span<const std::array<double, 3>> points, std::array<double, 2> distances)
    : settings_(settings) {
  const double step_of_sound = settings.speed_of_sound * settings.interval;
  for (const std::array<double, 3>& point : points) {
    Path path{};
    for (int k = 0; k < 3; ++k) path.direction[k] = position[k] - point[k];
    path.distance = std::hypot(path.direction[0], path.direction[1], path.direction[2]);
    for (double& component : path.direction) component /= path.distance;
    path.delay = static_cast<long>(std::floor(path.distance / step_of_sound));
    path.fraction = path.distance / step_of_sound - static_cast<double>(path.delay);
    paths_.push_back(path);
  }
  first_ = static_cast<long>(std::floor(distances[0] / step_of_sound));
  newest_delay_ = static_cast<long>(std::floor(distances[1] / step_of_sound)) + 1;
  std::size_t series = series_in_space;
  if (settings.dimension == 3) {
    length_ = static_cast<std::size_t>(newest_delay_ + 2 * least_intervals);
  } else {
    length_ = static_cast<std::size_t>(std::ceil(settings.end / settings.interval)) + newest_delay_ + least_intervals;
    nodes_ = response_delays(distances[0] / settings.speed_of_sound, distances[1] / settings.speed_of_sound);
    for (const Path& path : paths_) {
      const auto weights = interpolation_weights(nodes_, path.distance / settings.speed_of_sound);
      weights_.insert(weights_.end(), weights.begin(), weights.end());
    }
    series = nodes_.size() * (settings.hears_mass ? 2 : 1);
    fill_responses();
  }
  sums_.assign(series * length_, 0.0);
}

/// Of a rate that rises to 1 in the interval before it arrived, and falls in the one after, that many intervals ago.
void ListeningPoint::fill_responses() {
  const double interval = settings_.interval;
  for (int mass = 0; mass <= (settings_.hears_mass ? 1 : 0); ++mass) {
    for (const double delay : nodes_) {
      const auto response = [&](std::size_t n) {
        const double since = (static_cast<double>(n) - 1) * interval;  // one more comes first: before the front
        return mass ? line_mass_response(since, delay) : line_force_response(since, delay, settings_.speed_of_sound);
      };
      for (std::size_t n = 0; n < length_; ++n) {
        response_.push_back((response(n + 2) - 2 * response(n + 1) + response(n)) / interval);
      }
    }
  }
}

void ListeningPoint::add(std::size_t series, long number, const Path& path, double value) {
  sum(series, number + path.delay) += (1 - path.fraction) * value;
  sum(series, number + path.delay + 1) += path.fraction * value;
}

void ListeningPoint::send(long number, std::span<const Emission> emissions) {
  assert(emissions.size() == paths_.size());
  // The newest instant takes the place of one that was heard; in the plane all are kept, and it is none yet.
  for (std::size_t series = 0; series < sums_.size() / length_; ++series) sum(series, number + newest_delay_) = 0;
  const std::size_t nodes = nodes_.size();
  for (std::size_t i = 0; i < paths_.size(); ++i) {
    const Path& path = paths_[i];
    const auto& [force, mass_rate] = emissions[i];
    const double towards = force[0] * path.direction[0] + force[1] * path.direction[1] + force[2] * path.direction[2];
    if (settings_.dimension == 3) {
      const double spread = 1 / (4 * std::numbers::pi * path.distance);
      add(rated, number, path, spread * (towards / settings_.speed_of_sound + mass_rate));
      add(plain, number, path, spread * towards / path.distance);
      continue;
    }
    for (std::size_t k = 0; k < nodes; ++k) {
      const double weight = weights_[i * nodes + k];
      add(k, number, path, weight * towards);
      if (settings_.hears_mass) add(nodes + k, number, path, weight * mass_rate);
    }
  }
}

double ListeningPoint::pressure(double time) const {
  const double place = time / settings_.interval;
  const long instant = static_cast<long>(std::floor(place + rounding));
  const double part = std::max(place - static_cast<double>(instant), 0.0);
  const double before = pressure_at(instant);
  return part <= rounding ? before : (1 - part) * before + part * pressure_at(instant + 1);
}

double ListeningPoint::pressure_at(long instant) const {
  return settings_.dimension == 3 ? pressure_in_space(instant) : pressure_in_plane(instant);
}

double ListeningPoint::arrived(std::size_t series, long instant) const {
  if (instant < first_) return 0;
  return sums_[series * length_ + static_cast<std::size_t>(instant) % length_];
}

double ListeningPoint::pressure_in_space(long instant) const {
  const double change = arrived(rated, instant + 1) - arrived(rated, instant - 1);
  return change / (2 * settings_.interval) + arrived(plain, instant);
}

double ListeningPoint::pressure_in_plane(long instant) const {
  double result = 0;
  for (std::size_t series = 0; series < sums_.size() / length_; ++series) {
    const double* sums = sums_.data() + series * length_;
    const double* response = response_.data() + series * length_;
    for (long n = std::max(first_, 1L); n <= instant; ++n) {
      result += (sums[n + 1] - sums[n - 1]) * response[instant - n];
    }
  }
  return result / (2 * settings_.interval);
}

void ListeningPoint::set_sums(std::vector<double> sums) {
  assert(sums.size() == sums_.size());
  sums_ = std::move(sums);
}

}  // namespace vocalis::coupling
