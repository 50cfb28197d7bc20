#pragma once

#include <array>
#include <string>
#include <vector>

namespace vocalis::acoustic {

enum class Integrator {
  automatic,  ///< the cheaper one, by an estimate
  implicit,   ///< generalised-α: a linear system a step, of any length
  leap_frog   ///< explicit: as many sub-steps as stability asks for
};

enum class AcousticBoundaryKind {
  rigid,             ///< u·n = 0; what an unnamed boundary is
  admittance,        ///< u·n = µ p / (ρ c)
  yielding,          ///< u·n = ẇ with m ẅ + b ẇ + k w = p
  viscothermal,      ///< losses of the boundary layer: u·n ~ sqrt(iω) p
  open,              ///< first-order spherical: u·n = p / (ρ c) + 1 / (ρ R) ∫ p dt
  pressure_release,  ///< p = 0
  flux               ///< where the prescribed source enters: -u·n = g(t)
};

/// Whether what such a wall does depends on what it did before.
inline bool yields(AcousticBoundaryKind kind) {
  return kind == AcousticBoundaryKind::yielding || kind == AcousticBoundaryKind::viscothermal;
}

/// Where the particle velocity lies; the pressure is in P1.
enum class VelocityElements {
  p0,  ///< ∇P1: needs no stabilisation
  p1   ///< equal order, stabilised by orthogonal subscales; implicit only
};

struct AcousticBoundary {
  std::string group;
  AcousticBoundaryKind kind = AcousticBoundaryKind::rigid;
  double admittance = 0.005;  ///< µ [-], specific
  double radius = 0;          ///< R [m] of the open sphere (circle in 2-D); 0: plane

  // Yielding; the cheek, relaxed, after Ishizaka, French & Flanagan 1975.
  double mass = 21;           ///< m [kg/m^2]
  double resistance = 8000;   ///< b [Pa s/m]
  double stiffness = 845000;  ///< k [Pa/m]

  // Viscothermal; air at 305 K, where c = 350 m/s.
  double kinematic_viscosity = 1.64e-5;  ///< ν [m^2/s]
  double thermal_diffusivity = 2.32e-5;  ///< α [m^2/s]
  double heat_capacity_ratio = 1.4;      ///< γ [-]
  bool operator==(const AcousticBoundary&) const = default;
};

/// Sides of the mesh's bounding box.
enum class BoxSide { x_min, x_max, y_min, y_max, z_min, z_max };

enum class LayerKind {
  pml,    ///< perfectly matched: waves of all directions enter it unreflected
  sponge  ///< p and u are damped alike: so do waves at a right angle
};

/// A layer in front of sides of the mesh's bounding box that absorbs sound. A boundary behind it that no
/// `AcousticBoundary` names is open and plane.
struct AbsorbingLayer {
  LayerKind kind = LayerKind::pml;
  std::vector<BoxSide> sides;
  double thickness = 0;      ///< [m]
  double reflection = 1e-3;  ///< of a plane wave at a right angle, there and back from a rigid end
  bool may_grow = false;     ///< take thin layers along two of three axes too: good for short times only
  bool operator==(const AbsorbingLayer&) const = default;
};

/// What cells of the flow that have become solid in a contact are to the sound.
enum class ContactCells {
  keep,  ///< air, as before
  strip  ///< no part of the air: what is behind them is not heard
};

/// How the rate of the flow's pressure is made of its values at the flow's steps.
enum class PressureDerivative {
  step,       ///< (p - p before) / dt throughout a step: its integral in time is exact
  bdf2,       ///< second order at both ends of a step, linear between them
  five_point  ///< blind to what alternates from step to step; sound lags the flow by two steps
};

/// How sound is taken from a flow: what analogies are made from; the solver itself reads none of it.
struct AnalogySettings {
  std::string name = "pressure_rate";
  PressureDerivative pressure_derivative = PressureDerivative::step;
  double fade_in = 0;      ///< [s] over which the source rises
  bool mean_flow = false;  ///< the flow that carries sound is the mean, not the present one
  double mean_time = 0;    ///< T [s] of that mean, which forgets as exp(-t / T)
  bool convection = true;  ///< the flow carries sound in the wave operator, too
  std::array<double, 3> window_centre = {0, 0, 0};
  double window_radius = 0;  ///< [m] the source is whole within, 0: everywhere
  double window_width = 0;   ///< [m] beyond which it has faded away
  bool operator==(const AnalogySettings&) const = default;
};

/// One acoustic solver: its medium, boundaries and step.
struct AcousticSettings {
  std::string name = "sound";
  AnalogySettings analogy;
  double speed_of_sound = 350;  ///< c [m/s]
  double density = 1.2;         ///< ρ [kg/m^3]
  double wall_admittance = 0;   ///< µ [-] of every boundary that is not named; 0: rigid
  double step = 0;              ///< largest sub-step [s], > 0
  Integrator integrator = Integrator::implicit;
  double spectral_radius = 1;      ///< r of `GeneralisedAlpha`: 1 loses no energy
  double solver_tolerance = 1e-8;  ///< relative residual of a step's change of pressure
  VelocityElements velocity_elements = VelocityElements::p0;
  double subscale_constant = 0.02;  ///< C [-] of the subscales' time τ = C h / c
  ContactCells contact_cells = ContactCells::keep;
  std::vector<AcousticBoundary> boundaries;
  std::vector<AbsorbingLayer> layers;
  bool operator==(const AcousticSettings&) const = default;
};

/// Whether two sounds on one mesh have all but their source in common.
inline bool differ_in_source_alone(AcousticSettings one, const AcousticSettings& other) {
  one.name = other.name;
  one.analogy = other.analogy;
  return one == other;
}

enum class MicrophoneKind {
  mesh,      ///< in a cell of the air
  far_field  ///< outside of a surface of the mesh, by Kirchhoff's integral over it
};

/// A rigid plane, or one of symmetry: the coordinate `axis` is `position` [m].
struct MirrorPlane {
  int axis = 0;
  double position = 0;
  bool operator==(const MirrorPlane&) const = default;
};

struct MicrophoneSettings {
  std::string name;
  std::array<double, 3> position = {0, 0, 0};  ///< [m]
  MicrophoneKind kind = MicrophoneKind::mesh;
  std::string surface = "";               ///< group of facets, of a far-field microphone
  std::vector<MirrorPlane> mirrors = {};  ///< that the surface ends at, of different axes
};

}  // namespace vocalis::acoustic
