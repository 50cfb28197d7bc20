#pragma once

#include <array>
#include <functional>
#include <vector>

#include "core/fem/field.hpp"

namespace vocalis::fsi {

/// All that a step begins from; a checkpoint is this and nothing else. Ghosts current. All fields stand on
/// `FsiSolver::velocity_space`, the pressure on `FsiSolver::pressure_space`.
struct State {
  fem::Field velocity;         ///< [m/s] at `time`
  fem::Field velocity_before;  ///< one step earlier
  fem::Field displacement;     ///< d [m]: of the material in solids, of the mesh in the fluid
  fem::Field displacement_before;
  fem::Field pressure;                  ///< [Pa] at `time` with BDF2, at the stage t - (1 - θ) dt with θ
  fem::Field acceleration;              ///< rate of the velocity at the last stage [m/s^2]; predicts
  std::vector<char> in_contact;         ///< (owned cells) contact cells; empty where walls cannot touch
  std::vector<double> closing_points;   ///< of them, see Continuum::closing_points
  std::vector<double> contact_normals;  ///< of them, see Continuum::contact_normals
  std::vector<double> mesh_offset;      ///< (vertices, dimension) [m] of the fluid's mesh from where the smoother has
                                        ///< it, since cells opened; ghosts current; empty likewise
  std::array<double, 2> largest_speeds = {0, 0};  ///< so far, of fluid and solids, see `speeds` [m/s]
  double time = 0;                                ///< [s]
  double last_dt = 0;                             ///< [s]; 0: no step yet
};

/// Prescribed functions of a point [m] and a time [s], for verification; each may be empty. Only the first `dimension`
/// components count. Points of the fluid are where it is now, those of solids in the reference.
struct Prescribed {
  using Function = std::function<std::array<double, 3>(const std::array<double, 3>& point, double time)>;
  Function mesh_displacement;  ///< [m] of every fluid vertex not on a solid, instead of the smoother; of its reference
  Function velocity;           ///< [m/s] on boundaries of kind `velocity`, instead of their value
  Function fluid_force;        ///< [N/m^3]
  Function solid_force;        ///< [N/m^3] of reference volume
};

}  // namespace vocalis::fsi
