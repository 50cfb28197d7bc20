#pragma once

#include <memory>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/explicit_step.hpp"
#include "acoustic_solver/implicit_step.hpp"
#include "acoustic_solver/wave_operator.hpp"

namespace vocalis::acoustic {

/// All that follows from a mesh and the settings. Made anew for another mesh.
struct AcousticSolver::Discretisation {
  Discretisation(const mesh::Mesh& on, const AcousticSettings& given)
      : mesh(&on),
        settings(given),
        space(fem::lagrange(on, 1)),
        wave(on, space, given),
        layers(on, given),
        walls(on, wave),
        leap_frog(on, space, wave, given.density) {}

  ImplicitStep& implicit() {
    if (!implicit_step) implicit_step = std::make_unique<ImplicitStep>(*mesh, space, wave, layers, walls, settings);
    return *implicit_step;
  }
  void drop() {
    if (implicit_step) implicit_step->drop();
    leap_frog.drop();
    bound_standing_still = 0;
  }
  /// A bound of the explicit integrator's stable step [s] on the present geometry.
  double bound() {
    if (bound_standing_still == 0) bound_standing_still = leap_frog.stable_step(true);
    return bound_standing_still;
  }

  const mesh::Mesh* mesh;
  AcousticSettings settings;
  fem::Space space;
  WaveOperator wave;
  Layers layers;
  YieldingWalls walls;
  ExplicitStep leap_frog;
  std::unique_ptr<ImplicitStep> implicit_step;  ///< once it is needed
  bool is_shared = false;                       ///< by sounds that take the same sub-steps one after another
  double bound_standing_still = 0;              ///< [s]; 0: not known
};

}  // namespace vocalis::acoustic
