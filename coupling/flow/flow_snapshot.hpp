#pragma once

#include <vector>

namespace vocalis::coupling {

/// The flow at one time, at the vertices of the flow mesh, ghosts current: all that sound asks of it, whether it was
/// solved, recorded or is given by a formula.
struct FlowSnapshot {
  double time = 0;                        ///< [s]
  std::vector<double> pressure;           ///< (vertices) p_ic [Pa], meant at vertices of fluid cells only
  std::vector<double> velocity;           ///< (vertices, dimension) u_ic [m/s]
  std::vector<double> velocity_of_edges;  ///< (edges, dimension) in their middles, of quadratic velocities; or empty
  std::vector<double> displacement;       ///< (vertices, dimension) of the mesh from its place at rest [m]
  std::vector<char> in_contact;           ///< (owned cells) in contact in the step that ended here; empty: none can be
};

}  // namespace vocalis::coupling
