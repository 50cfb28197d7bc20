#pragma once

#include <vector>

#include "coupling/flow/flow_snapshot.hpp"
#include "coupling/scene.hpp"
#include "fsi_solver/fsi_solver.hpp"

namespace vocalis::coupling {

/// Takes snapshots of a flow that is solved. Which pressure belongs to a vertex is found once.
class SolvedFlow {
 public:
  /// Scene and solver must outlive it.
  SolvedFlow(const Scene& scene, const fsi::FsiSolver& flow);

  /// The accepted state.
  FlowSnapshot snapshot() const;

 private:
  std::vector<double> velocity_of_edges() const;

  const fsi::FsiSolver& flow_;
  std::vector<std::int32_t> vertex_to_pressure_;  ///< dof of the fluid's pressure, or -1
  std::vector<std::int32_t> edge_to_velocity_;    ///< dof; empty where velocities are linear
};

}  // namespace vocalis::coupling
