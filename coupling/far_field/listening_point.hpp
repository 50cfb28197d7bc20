#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vocalis::coupling {

/// What a piece of a surface does to the fluid outside of it. In the plane all is per metre of depth.
struct Emission {
  std::array<double, 3> force = {0, 0, 0};  ///< on the fluid [N]
  double mass_rate = 0;                     ///< that it gives off [kg/s]
};

/// What a listening point must know of the air and the run.
struct ListeningSettings {
  int dimension = 3;
  double speed_of_sound = 350;  ///< c [m/s]
  double interval = 0;          ///< Δ [s] of the equally spaced instants at which sound is sent and heard, > 0
  double end = 0;               ///< [s] of the run
  bool hears_mass = true;       ///< false: all mass rates are 0
};

/// One point in air at rest that hears points which send forces L and masses q (the formula of Ffowcs Williams and
/// Hawkings for a surface at rest, as Farassat's 1A has it at Mach number 0). In space, r̂ from the source to here,
///
///   4π p = Σ [q̇ / r + L̇·r̂ / (c r) + L·r̂ / r²]  at t - r / c;
///
/// in the plane each source is a line, see `line_mass_response`.
///
/// Sources send at equally spaced instants. What is sent is added to what arrives r / c later (advanced time: Casalino
/// 2003, J. Sound Vib. 261, 583), shared out to the two instants around linearly. In space this is kept for as long as
/// sound is under way; the rate is taken of what has arrived, by central differences. In the plane what has arrived
/// since the beginning is convolved with the response to its rate, linear between instants: what arrives is sorted by
/// some few delays, between which the response is interpolated, so that no source has a history of its own. All of it
/// is of second order in the interval.
///
/// Each rank has sources of its own: pressures are sums over the ranks.
class ListeningPoint {
 public:
  /// Sources at `points` [m], whose distances lie between the nearest and the farthest of all ranks [m].
  ListeningPoint(const ListeningSettings& settings, const std::array<double, 3>& position,
                 std::span<const std::array<double, 3>> points, std::array<double, 2> distances);

  /// Sends what the sources emit at instant `number`: 1, 2, ... in order; before, there was silence.
  void send(long number, std::span<const Emission> emissions);
  /// This rank's part of the pressure [Pa] at a time not later than the last instant sent, and not earlier than the one
  /// before it. The nearest source must be `least_intervals` away.
  double pressure(double time) const;

  static constexpr int least_intervals = 3;

  /// What has arrived and is on its way, (series, instants): all that later pressures depend on.
  const std::vector<double>& sums() const { return sums_; }
  void set_sums(std::vector<double> sums);

 private:
  struct Path {
    std::array<double, 3> direction;  ///< r̂
    long delay;                       ///< whole intervals
    double fraction;                  ///< of an interval, that it arrives later
    double distance;                  ///< r [m]
  };
  double& sum(std::size_t series, long instant) {
    return sums_[series * length_ + static_cast<std::size_t>(instant) % length_];
  }
  double arrived(std::size_t series, long instant) const;
  void fill_responses();
  void add(std::size_t series, long number, const Path& path, double value);
  double pressure_at(long instant) const;
  double pressure_in_space(long instant) const;
  double pressure_in_plane(long instant) const;

  ListeningSettings settings_;
  std::vector<Path> paths_;
  long first_ = 0;                ///< instant before which nothing arrives
  long newest_delay_ = 0;         ///< intervals after which the last of an instant has arrived
  std::size_t length_ = 0;        ///< instants that are kept
  std::vector<double> nodes_;     ///< delays of the responses in the plane [s]
  std::vector<double> weights_;   ///< (sources, nodes) of them
  std::vector<double> response_;  ///< (series, instants) of a rate over one interval, in the plane
  std::vector<double> sums_;
};

}  // namespace vocalis::coupling
