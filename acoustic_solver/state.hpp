#pragma once

#include <functional>
#include <string>
#include <vector>

namespace vocalis::acoustic {

/// What a step moves on. One number a local vertex, ghosts current, but for what says otherwise.
struct Unknowns {
  std::vector<double> p;               ///< acoustic pressure [Pa]
  std::vector<double> psi;             ///< velocity potential [m^2/s], u = -∇ψ
  std::vector<double> layer_flux;      ///< φ of absorbing layers, (owned layer cells, dimension) [m/s]
  std::vector<double> layer_integral;  ///< w = ∫ψ dt [m^2], where a layer in space has corners; or empty
  std::vector<double> wall_motion;     ///< of walls that yield, as `YieldingWalls` lays it out [m/s, m]
};

/// All that a later step depends on: a checkpoint of the acoustics is this.
struct State : Unknowns {
  double time = 0;                           ///< [s]
  bool has_rates = false;                    ///< on all ranks alike; else not known, or not needed
  Unknowns rates;                            ///< of all unknowns at fixed vertices [1/s]
  std::vector<std::vector<double>> earlier;  ///< p one, two and three sub-steps ago: for the starting guess alone
};

/// What an integrator is given for one sub-step. A source varies linearly in it.
struct SubStep {
  double begin = 0;          ///< [s]
  double dt = 0;             ///< [s]
  bool moves = false;        ///< some vertex moves during it
  bool convects = false;     ///< that, or the medium flows
  bool is_shared = false;    ///< other sounds take the same sub-step
  int slot = 0;              ///< which of the systems that are kept is for it
  std::vector<double> load;  ///< (Q, q) where the integrator wants it, at the owners [m^3/s; m^2/s in the plane];
                             ///< empty: no source
  std::vector<double> load_change;        ///< of it, from begin to end; empty: no source
  double flux = 0;                        ///< g where the integrator wants it [m/s]
  std::function<double(double)> flux_at;  ///< g at a time [m/s]; empty: none
  std::function<void(double)> place;      ///< moves the geometry to a part of the sub-step, 0 to 1; empty: it stands
};

struct AdvanceReport {
  bool converged = true;      ///< else the state is that of the last sub-step that converged
  int sub_steps = 0;          ///< that the integrator took
  int linear_iterations = 0;  ///< over all sub-steps
  int passes = 0;             ///< linear solves: one a sub-step where nothing convects
  std::string reason;         ///< empty when converged
};

}  // namespace vocalis::acoustic
