#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/fem/field.hpp"
#include "coupling/scene.hpp"
#include "coupling/voice/flow_bridge.hpp"
#include "transfer/carry.hpp"

namespace vocalis::coupling {

/// The air that a voice sounds in: the scene's acoustic mesh, or that without cells in contact, or a mesh of its own
/// that stands still or follows the flow's. Whole at construction, for as long as the same cells are in contact.
struct Air {
  transfer::StrippedMesh* stripped = nullptr;           ///< the scene's, or `own`
  std::unique_ptr<transfer::StrippedMesh> own;          ///< without cells in contact; or of its own: no parent, no maps
  bool is_separate = false;                             ///< a mesh of its own
  bool follows = false;                                 ///< which moves as the flow's does
  std::vector<std::int32_t> cell_has_flow;              ///< (owned cells)
  std::vector<double> rest_coordinates;                 ///< (vertices, dimension) [m]
  std::unique_ptr<transfer::SharedVertices> from_flow;  ///< none without a flow; on a mesh of its own it is `bridge`
  std::unique_ptr<FlowBridge> bridge;

  mesh::Mesh& mesh() const { return stripped->mesh; }
  bool moves() const { return !is_separate || follows; }
};

/// in_contact  (owned cells of the flow mesh) not 0: no part of the air; empty: none
/// The scene must outlive the air. Collective.
std::unique_ptr<Air> make_air(Scene& scene, std::span<const char> in_contact);

/// The air of an [[acoustic]], given by its name: on the mesh that the case gives it, or the scene's. Throws UserError
/// for what a mesh of its own does not have or does not cover. The scene must outlive the air. Collective.
std::unique_ptr<Air> make_air(Scene& scene, const Case& config, const std::string& name);

/// Loads on the flow mesh, as each rank has summed them, on the air's; whole at the owners. Collective.
void carry(const Air& air, const fem::Load& from, fem::Load& to);

/// What of_flow_vertices are at the air's vertices that the flow has; else 0. `of_flow_vertices` may be empty: 0.
/// Collective.
std::vector<double> values_of_flow(const Scene& scene, const Air& air, const std::vector<double>& of_flow_vertices,
                                   int components);

/// Where the flow's displacement [m] puts the vertices, (vertices, dimension) [m]; a mesh of its own stays, or takes
/// part where it is in the flow. `space` is P1 on the air. Collective.
std::vector<double> moved_coordinates(const Air& air, const fem::Space& space, const fem::Field& displacement);

/// Whether no cell of a mesh of its own is turned over by these coordinates (vertices, dimension) [m], ghosts current:
/// the flow's mesh is smooth on its own cells, not on larger ones. Collective.
bool keeps_its_cells(const Air& air, std::span<const double> coordinates);

/// Numbers in `after` of the local vertices of `before`, or -1.
std::vector<std::int32_t> vertices_there(const Air& before, const Air& after);

}  // namespace vocalis::coupling
