#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "acoustic_solver/control_surface.hpp"
#include "acoustic_solver/settings.hpp"
#include "acoustic_solver/six_points.hpp"

namespace vocalis::acoustic {

/// What far-field microphones need to know of the air and of the run.
struct FarFieldSettings {
  double speed_of_sound = 350;           ///< c [m/s]
  double interval = 0;                   ///< Δ [s] of the equally spaced times that sound is sent and heard at, > 0
  std::vector<std::int32_t> has_source;  ///< (owned cells of the mesh) where sound is made, see `control_surface`
};

/// Sound outside of a surface S that stands still around all sources and walls (Kirchhoff; Ffowcs Williams & Hawkings
/// 1969 for a permeable surface at rest in linear acoustics), n outwards, r from the surface to the microphone:
///
///   4π p(x, t) = ∫ [ -∂p/∂n / r + (n·r̂) (p / r² + ṗ / (c r)) ] dS  at t - r / c,        -∂p/∂n = ρ u̇_n.
///
/// Each sample of the surface is sent forward in time (advanced time: Casalino 2003, J. Sound Vib. 261, 583): it is
/// added to what the microphone will hear at t + r / c, so that nothing of the past of the surface is kept. Time is
/// interpolated, and differentiated for ṗ and p̈, by the polynomial of degree five through six samples. Its powers are
/// summed apart, over all points of the surface, and put together once an instant (Farrow 1988), which makes a path
/// from a vertex to a microphone cost some thirty operations a sample.
///
/// A baffle or a plane of symmetry is a mirror: the image of the surface sends, too. The air outside is at rest,
/// unbounded or bounded by the mirrors. Each rank sends what it has of the surface: microphones' pressures are sums
/// over the ranks.
class FarField {
 public:
  /// All that later pressures depend on, on this rank.
  struct State {
    std::vector<double> clock;      ///< six times of samples [s], then the number of the next interval to be sent
    std::vector<double> pressures;  ///< (6, skin) samples of p [Pa]
    std::vector<double> sums;       ///< (microphones, instants, 6) powers still to be heard [Pa]
  };

  /// The mesh at its present coordinates; silence. All microphones have the surface and mirrors of the first.
  /// Throws UserError: what `control_surface` does not take; a surface with an opening (its area vectors and those of
  /// its images must sum to zero), or that passes a mirror; a microphone inside the surface, behind a mirror, or nearer
  /// to the surface than ten intervals of sound or a facet's edge. Collective.
  FarField(const mesh::Mesh& mesh, const std::vector<MicrophoneSettings>& microphones,
           const FarFieldSettings& settings);

  /// Takes a sample, later than the one before, of a P1 function: (vertices). Not collective.
  void sample(double time, std::span<const double> vertex_pressure);
  /// This rank's part of the pressure that a microphone hears at a time, the last sample's [Pa].
  double pressure(std::size_t microphone, double time) const;

  /// Throws UserError if a vertex of the surface's skin is elsewhere than when the surface was made. Collective.
  void require_still(const mesh::Mesh& mesh, std::span<const double> coordinates) const;

  /// The mesh is another one, with all cells along the surface, at the same places.
  ///
  /// vertex_there  (vertices of the mesh before) the number there, or -1
  void renumber(std::span<const std::int32_t> vertex_there);

  /// (vertices of the cells along the surface on this rank, 3) [m]
  std::span<const double> skin_points() const { return skin_points_; }

  const State& state() const { return state_; }
  void set_state(State state);

 private:
  /// From a vertex of the surface, or its image, to a microphone.
  struct Path {
    std::int32_t vertex;
    std::int32_t delay;  ///< r / c in intervals, rounded up
    double fraction;     ///< by how much it was rounded up
    double monopole;     ///< 1 / (4π r) [1/m]
    double near;         ///< n·r̂ / (4π r²), weighed with the area [-]
    double far;          ///< n·r̂ / (4π c r Δ), the same
  };

  void add_paths(std::size_t microphone, const MicrophoneSettings& settings);
  void send();
  /// Where the six sums of an instant begin. Instants are a ring: numbers from 0 on.
  std::size_t sums_of(std::size_t microphone, long instant) const {
    return (microphone * length_ + static_cast<std::size_t>(instant) % length_) * six;
  }

  MPI_Comm comm_;
  FarFieldSettings settings_;
  ControlSurface surface_;
  std::vector<double> skin_points_;                   ///< (skin, 3) [m]
  std::vector<std::vector<Path>> paths_;              ///< of each microphone
  std::int32_t least_delay_ = 0, largest_delay_ = 0;  ///< over all ranks and microphones
  std::size_t length_ = 0;                            ///< instants that the sums are kept for
  std::vector<double> pressure_, flux_, inertia_;     ///< (vertices of the surface) work space of `send`
  State state_;
};

}  // namespace vocalis::acoustic
