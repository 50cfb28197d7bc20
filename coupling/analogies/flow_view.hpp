#pragma once

#include <vector>

#include "core/fem/space.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::coupling {

/// What an analogy may see of one accepted flow step from t to t + dt. All arrays live on the vertices of the flow
/// mesh; ghosts are current. Tests fill it from formulas, without a flow solver.
struct FlowView {
  const fem::Space* space = nullptr;                 ///< P1 on the whole flow mesh: dofs are its vertices
  double time_begin = 0, time_end = 0;               ///< [s]
  std::vector<std::int32_t> cell_is_fluid;           ///< (owned cells) at the beginning and throughout
  std::vector<std::int32_t> vertex_is_silent;        ///< (vertices) of cells that were or are in contact: p_ic there is
                                                     ///< not the air's at both times; empty: none
  std::vector<mesh::NamedFacet> outlet;              ///< facets where the flow ends inside the air
  std::vector<mesh::NamedFacet> walls;               ///< facets where it ends elsewhere
  std::vector<double> coordinates_middle;            ///< (vertices, d) [m] half-way through the step
  std::vector<double> mesh_velocity;                 ///< (vertices, d) β [m/s]
  std::vector<double> pressure_begin, pressure_end;  ///< (vertices) p_ic [Pa], meant at vertices of fluid cells only
  std::vector<double> velocity_begin, velocity_end;  ///< (vertices, d) u_ic [m/s]
  std::vector<double> edges_begin, edges_end;        ///< (edges, d) u_ic in the middles of edges; empty: linear
  std::vector<double> pressure_rate_begin, pressure_rate_end;  ///< (vertices) ∂t p|χ [Pa/s]; both empty: the difference
                                                               ///< of the pressures over dt, throughout
};

inline std::vector<double> mean_of(const std::vector<double>& begin, const std::vector<double>& end) {
  std::vector<double> result = begin;
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = 0.5 * (result[i] + end[i]);
  return result;
}

/// u_ic half-way through the step, (vertices, d) and (edges, d) [m/s].
inline std::vector<double> middle_velocity(const FlowView& flow) {
  return mean_of(flow.velocity_begin, flow.velocity_end);
}
inline std::vector<double> middle_of_edges(const FlowView& flow) { return mean_of(flow.edges_begin, flow.edges_end); }

}  // namespace vocalis::coupling
