#pragma once

#include <array>
#include <vector>

#include "acoustic_solver/settings.hpp"
#include "core/mesh/mesh.hpp"

namespace vocalis::acoustic {

/// One side of the mesh's bounding box with a layer in front of it.
struct LayerSide {
  int axis = 0;
  double inner = 0, outer = 0;  ///< where the layer begins and ends on the axis [m]
  double greatest = 0;          ///< damping at its end [1/s]
};

/// The layers of the settings on this mesh, with the damping that leaves `reflection` of a plane wave that falls on the
/// layer at a right angle and comes back from a rigid end: exp(-2/c ∫ s dx), s = greatest (depth / thickness).
///
/// The profile is linear: of the powers 0.5 to 3 it reflects least of plane waves where the layer has 6 to 15 cells
/// (docs/theory.md).
/// Throws UserError if a layer is thinner than two cells, so thin that sound grows in an edge of two layers
/// (unless it may), meets one
/// from the other side, or makes no sense otherwise. Collective.
std::vector<LayerSide> layer_sides(const mesh::Mesh& mesh, const AcousticSettings& settings);

/// Damping s_i along axis i, from the beginning of the layer to x [m/s]: its slope between the vertices of a cell is
/// the damping of the cell.
double damping_up_to(const std::vector<LayerSide>& sides, int axis, double x);

/// Whether all of `facet` lies where a layer ends.
bool ends_a_layer(const mesh::Mesh& mesh, const std::vector<LayerSide>& sides, const mesh::NamedFacet& facet);

}  // namespace vocalis::acoustic
