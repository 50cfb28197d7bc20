#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/fem/field.hpp"
#include "coupling/analogies/flow_view.hpp"
#include "coupling/scene.hpp"
#include "transfer/point_interpolation.hpp"

namespace vocalis::coupling {

/// The way from the flow to air on a mesh with cells and a partition of its own: loads by the transpose of the
/// interpolation of the air's functions at the flow's vertices, values by interpolation at the air's. Both meshes are
/// taken at rest, which is exact where the air follows the flow's mesh. Where it stands still and the folds have moved
/// by s, a source is heard from that much beside its place, an error of the order of s over the length of what it
/// sounds in. Vertices within a cell's size outside of the other mesh take part
/// at the nearest point of it, since boundaries with other cells differ by the sagitta of their facets.
class FlowBridge {
 public:
  /// The meshes at rest. `ends` are groups of the flow mesh behind which the air goes on. Throws UserError, in which
  /// `name` is the [[acoustic]], for flow outside of the air. Collective.
  FlowBridge(const Scene& scene, const mesh::Mesh& air, const std::vector<std::string>& ends, const std::string& name);

  /// Of P1 loads of fluid cells, as each rank has summed them over its own; the total is kept. On exit `to` is whole at
  /// its owners. Collective.
  void carry(const fem::Load& from, fem::Load& to) const;

  /// At the air's vertices, ghosts too, what P1 functions on the fluid are at the flow mesh's; 0 outside of the flow,
  /// and everywhere if `of_flow_vertices` is empty. Collective.
  std::vector<double> values(const std::vector<double>& of_flow_vertices, int components) const;

  /// Whether all of the vertices of each owned cell of the air are in the flow.
  std::vector<std::int32_t> cells_in_flow(const mesh::Mesh& air) const;

  /// The flow as this air sees it, if it is another one: its outlet is also where its boundary named `ends` is.
  std::optional<FlowView> with_ends(const FlowView& flow) const;

  /// Of the flow's vertices from the air.
  const transfer::PointsOutside& outside() const { return to_air_.outside(); }

 private:
  fem::Space flow_space_;
  std::vector<std::int32_t> fluid_vertices_;  ///< of this rank's fluid cells
  std::vector<mesh::NamedFacet> ends_;        ///< of fluid cells
  transfer::PointInterpolation to_air_;       ///< the air's functions at fluid_vertices_
  transfer::PointInterpolation to_flow_;      ///< the flow's functions at the air's vertices
};

}  // namespace vocalis::coupling
