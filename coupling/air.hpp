#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/fem/field.hpp"
#include "coupling/scene.hpp"
#include "transfer/carry.hpp"

namespace vocalis::coupling {

/// The air that a voice sounds in: the scene's acoustic mesh, or one of its own without cells in contact. Whole at
/// construction, for as long as the same cells are in contact.
struct Air {
  transfer::StrippedMesh* stripped = nullptr;           ///< the scene's, or `own`
  std::unique_ptr<transfer::StrippedMesh> own;          ///< without cells in contact
  std::vector<std::int32_t> cell_has_flow;              ///< (owned cells)
  std::vector<double> rest_coordinates;                 ///< (vertices, dimension) [m]
  std::unique_ptr<transfer::SharedVertices> from_flow;  ///< none without a flow

  mesh::Mesh& mesh() const { return stripped->mesh; }
};

/// in_contact  (owned cells of the flow mesh) not 0: no part of the air; empty: none
/// The scene must outlive the air. Collective.
std::unique_ptr<Air> make_air(Scene& scene, std::span<const char> in_contact);

/// Where the flow's displacement [m] puts the vertices, (vertices, dimension) [m]. `space` is P1 on the air.
/// Collective.
std::vector<double> moved_coordinates(const Air& air, const fem::Space& space, const fem::Field& displacement);

/// Numbers in `after` of the local vertices of `before`, or -1.
std::vector<std::int32_t> vertices_there(const Air& before, const Air& after);

}  // namespace vocalis::coupling
