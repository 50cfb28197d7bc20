#pragma once

#include <memory>
#include <optional>
#include <span>

#include "core/base/timers.hpp"
#include "fsi_solver/mesh_motion/mesh_motion.hpp"
#include "fsi_solver/mesh_motion/nonlinear_smoother.hpp"

namespace vocalis::fsi {

/// How the fluid's mesh follows the solids: by the linear smoother where its smallest quality q is good, by the
/// non-linear one where that is bad, and between by
///
///   d = (1 - s) d_linear + s d_nonlinear,   s = t² (3 - 2 t),   t = 2 (1 - q / smoother_quality) in [0, 1]
///
/// s depends on where the solids are alone: no threshold with memory, so that the mesh comes back when they do, and no
/// jump, which the mesh's velocity would show as a peak.
class MeshFollower {
 public:
  /// The references must outlive this; `timers` gets the phase "mesh_motion". Collective.
  MeshFollower(const Continuum& continuum, const Conditions& conditions, const FlowSettings& settings,
               base::Timers& timers);

  /// displacement  of all vertices at the beginning of a step
  /// offset        (vertices, dimension) [m] of these from where the smoother had them (State::mesh_offset), or empty
  ///
  /// Searches begin at the difference, and then at the last result: from elsewhere they may find another of several
  /// minima, and the mesh would jump. With the non-linear smoother's factors dropped, results depend on this and on the
  /// solids to the last bit.
  void begin_step(const fem::Field& displacement, std::span<const double> offset);
  void drop_factors();
  /// To be called when cells have become solid or fluid. Collective.
  void rebuild();

  /// displacement  of the vertices: where solids are given (owned ones suffice), elsewhere found; ghosts current on
  /// exit. If the non-linear smoother fails, the linear one's result stays. Collective.
  void extend(fem::Field& displacement);

 private:
  const Continuum& continuum_;
  base::Timers& timers_;
  const Conditions& conditions_;
  FlowSettings settings_;
  std::optional<MeshMotion> linear_;
  std::unique_ptr<NonlinearSmoother> nonlinear_;  ///< null with the linear one alone
  fem::Field start_;
};

}  // namespace vocalis::fsi
