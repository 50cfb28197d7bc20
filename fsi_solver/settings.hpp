#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace vocalis::fsi {

enum class SolidModel { neo_hookean, saint_venant_kirchhoff };

/// One solid region. The Lamé constants follow from E and ν; an incompressible material takes µ = E / 3.
struct SolidMaterial {
  std::string region;  ///< name of the group of cells
  SolidModel model = SolidModel::neo_hookean;
  bool incompressible = false;  ///< the pressure becomes an unknown there
  double density = 1040;        ///< ρs [kg/m^3]
  double young_modulus = 0;     ///< E [Pa], > 0
  double poisson_ratio = 0.4;   ///< ν [-], in (-1, 0.5); unused when incompressible
  double damping = 0;           ///< Kelvin–Voigt viscosity η [Pa s], S_v = 2 η dE/dt
};

enum class FlowBoundaryKind {
  velocity,        ///< v = value, essential
  wall,            ///< v = 0 where the wall is rigid; an elastic wall is an interface and needs no boundary
  symmetry,        ///< v·n = 0 on a straight axis-parallel boundary, free slip
  pressure,        ///< traction -p n
  total_pressure,  ///< a reservoir: where air comes in, p + ½ρ|v|² = value; energy-stable, unlike `pressure`
  outlet,          ///< traction -p n with backflow stabilisation
  fixed            ///< solids: d = 0
};

enum class VelocityProfile { uniform, parabolic };

/// What happens on one named group of facets. The values rise from 0 to their full size as (1 - cos(π t / ramp)) / 2,
/// and go on as sin(2π t / period) if there is one.
struct FlowBoundary {
  std::string group;
  FlowBoundaryKind kind = FlowBoundaryKind::wall;
  double pressure = 0;                                 ///< [Pa], for `pressure`, `total_pressure` and `outlet`
  std::array<double, 3> velocity = {0, 0, 0};          ///< [m/s], for `velocity`: (mean) velocity vector
  VelocityProfile profile = VelocityProfile::uniform;  ///< parabolic: 1.5 times the mean in the middle (2-D), by the
                                                       ///< distance between the end points of the group
  double ramp = 0;                                     ///< [s]; 0: at once
  double period = 0;                                   ///< [s]; 0: constant
};

enum class TimeScheme { theta, bdf2 };

struct TimeSettings {
  double end = 0;   ///< [s], > 0
  double step = 0;  ///< dt [s], > 0
  TimeScheme scheme = TimeScheme::bdf2;
  double theta = 0.5;        ///< one-leg θ in [0.5, 1]; ½ rings, ½ + O(dt) damps (Wick 2013)
  double smallest_step = 0;  ///< [s]; 0: dt / 64. A smaller step fails the run
  double tolerance = 0;      ///< relative local error that the step adapts to; 0: the step stays dt
  double largest_step = 0;   ///< [s] of an adaptive step; 0: dt
};

/// Velocity and pressure: both linear and stabilised, or Taylor–Hood on isoparametric cells.
enum class Elements { p1p1, p2p1 };

/// Where the fluid's mesh is during a step: found with the unknowns, or extrapolated before them.
enum class Geometry { implicit, explicit_ };

/// How the fluid's mesh follows the solids: linear elasticity alone, or a non-linear smoother where that gets bad.
enum class Smoother { linear, nonlinear };

/// Full: walls that touch stick together. None: the contact medium resists a change of its thickness, but neither with
/// stiffness nor with viscosity a shear along the plane of contact, see `sliding_stress`.
enum class Friction { full, none };

/// What a fluid cell between walls that touch becomes: an incompressible neo-Hookean solid whose reference is the shape
/// that it had when it closed.
/// Source: Degirmenci 2018, 3.2 (unified continuum contact).
struct ContactMedium {
  double young_modulus = 0;  ///< E [Pa], > 0
  double damping = 0;        ///< Kelvin–Voigt viscosity η [Pa s]
  Friction friction = Friction::full;
  double film_viscosity = 0;  ///< η_f [Pa s] against sliding without friction, see `sliding_stress`
};

struct FlowSettings {
  double density = 1.2;       ///< ρ [kg/m^3]
  double viscosity = 1.8e-5;  ///< µ [Pa s]
  std::vector<FlowBoundary> boundaries;
  std::vector<SolidMaterial> solids;
  std::array<double, 3> gravity = {0, 0, 0};  ///< body force of solids and fluid [m/s^2]
  double newton_tolerance = 1e-6;             ///< relative, per field and region
  int newton_iterations = 15;                 ///< a step that needs more is rejected and halved
  double backflow_stabilisation = 0.5;        ///< weight of -ρ (v·n)_- v·w at outlets, in [0, 1]
  Elements elements = Elements::p1p1;
  Geometry geometry = Geometry::implicit;
  bool streamline_stabilisation = true;  ///< orthogonal subscales of convection and divergence
  bool pressure_stabilisation = true;    ///< of P1P1, which cannot do without
  double mesh_stiffening = 1.0;          ///< exponent of 1 / volume in the elastic mesh smoother
  Smoother smoother = Smoother::linear;
  double smoother_quality =
      0.3;  ///< below this smallest quality of the fluid's mesh the non-linear smoother takes over
  std::optional<ContactMedium> contact;  ///< none: walls cannot touch
  double mesh_recovery = 0;              ///< [s] in which the mesh of cells that opened comes back, see `MeshFollower`
};

}  // namespace vocalis::fsi
