#pragma once

#include <algorithm>
#include <array>
#include <ctime>
#include <functional>
#include <map>
#include <span>

#include "coupling/flow/flow_history.hpp"
#include "coupling/voice/voice.hpp"
#include "tests/all_ranks.hpp"

namespace vocalis::coupling::test {

using Point = std::array<double, 3>;

/// A flow given by formulas of the place and time, on a mesh that may swing.
struct MadeFlow {
  std::function<double(const Point&, double)> pressure;     ///< [Pa]
  std::function<Point(const Point&, double)> velocity;      ///< [m/s]
  std::function<Point(const Point&, double)> displacement;  ///< of the place at rest [m]; empty: the mesh stands still
};

inline FlowSnapshot snapshot(const Scene& scene, const MadeFlow& flow, double time) {
  const mesh::Mesh& mesh = scene.flow->mesh;
  const int d = mesh.dimension;
  FlowSnapshot result;
  result.time = time;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    Point place = {0, 0, 0}, moved = {0, 0, 0};
    std::copy_n(mesh.point(v), d, place.begin());
    if (flow.displacement) moved = flow.displacement(place, time);
    for (int k = 0; k < d; ++k) place[k] += moved[k];
    const Point velocity = flow.velocity(place, time);
    result.pressure.push_back(flow.pressure(place, time));
    result.velocity.insert(result.velocity.end(), velocity.begin(), velocity.begin() + d);
    result.displacement.insert(result.displacement.end(), moved.begin(), moved.begin() + d);
  }
  return result;
}

/// A flow that voices follow from time 0 on, in steps of dt [s].
class Lead {
 public:
  /// Scene and voices must outlive it; the flow is copied.
  Lead(const Scene& scene, MadeFlow flow, double dt)
      : scene_(scene), flow_(std::move(flow)), dt_(dt), history_(scene, 6, false) {
    history_.restart(snapshot(scene, flow_, 0));
  }
  /// One more step, which each voice follows as far as its derivative is known. Collective.
  void step(std::span<Voice* const> voices) {
    ++steps_;
    history_.add(snapshot(scene_, flow_, steps_ * dt_));
    for (Voice* voice : voices) {
      if (!history_.has_step(voice->derivative())) continue;
      const FlowStep step = history_.step(voice->derivative());
      const std::clock_t begin = std::clock();
      CHECK(voice->follow(step).converged);
      seconds_[voice] += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    }
  }
  /// Where another one has come to, of the same flow on a scene of the same mesh.
  void go_on_from(const Lead& other) {
    steps_ = other.steps_;
    history_.set_snapshots(other.history_.snapshots());
  }
  double time() const { return steps_ * dt_; }
  /// Processor seconds of this rank that a voice took.
  double seconds(const Voice& voice) const { return seconds_.at(&voice); }
  FlowHistory& history() { return history_; }

 private:
  const Scene& scene_;
  MadeFlow flow_;
  double dt_;
  int steps_ = 0;
  FlowHistory history_;
  std::map<const Voice*, double> seconds_;
};

}  // namespace vocalis::coupling::test
