#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/fem/cell_map.hpp"
#include "core/mesh/facets.hpp"
#include "coupling/far_field/listening_point.hpp"
#include "coupling/far_field/surface_microphone_settings.hpp"
#include "coupling/flow/flow_snapshot.hpp"

namespace vocalis::coupling {

/// What the flow is made of, for the stress on a surface.
struct FlowMaterial {
  double density = 1.2;       ///< ρ [kg/m^3]
  double viscosity = 1.8e-5;  ///< µ [Pa s]
};

/// A surface of the flow mesh that is heard, as this rank sees it: facets of walls and interfaces with solids, whose
/// normal n points into the fluid, and facets inside the fluid, whose normal points to where the listener is: away from
/// the side that the far end of the mesh is not on. With w the velocity of the surface and u that of the fluid, a facet
/// of the area A gives off
///
///   L = [p n - µ (∇u + ∇uᵀ) n + ρ u (u - w)·n] A,        q = ρ u·n A.
///
/// ∇u is that of the linear function in the cell at the facet, of first order. Of Curle's walls q is not heard: they
/// may move, but shall not swell.
class FlowSurface {
 public:
  /// The mesh is the flow's in its place at rest, and must outlive this.
  ///
  /// cell_is_fluid  (local cells, ghosts too)
  /// Throws UserError: groups that have no facet at the fluid; facets inside the fluid with Curle's method; groups that
  /// do not part the fluid. Collective.
  FlowSurface(const mesh::Mesh& mesh, std::span<const std::int32_t> cell_is_fluid, const FlowMaterial& material,
              const SurfaceMicrophoneSettings& settings);

  std::size_t size() const { return facets_.size(); }
  /// Middles of the facets [m], and n A [m^2], at rest.
  const std::vector<fem::Point>& middles() const { return middles_; }
  const std::vector<fem::Point>& areas() const { return areas_; }
  double longest_edge() const { return longest_edge_; }  ///< of the facets of all ranks [m]

  /// What each facet gives off; `before` is an earlier snapshot, which tells how the surface moves.
  std::vector<Emission> emissions(const FlowSnapshot& before, const FlowSnapshot& flow) const;

 private:
  struct Facet {
    std::int32_t cell;
    int index;    ///< the vertex opposite to it
    double sign;  ///< of the normal that points out of the cell
  };
  void take(const mesh::NamedFacet& facet, double sign);
  template <int D>
  Emission emission(const Facet& facet, const FlowSnapshot& before, const FlowSnapshot& flow) const;

  const mesh::Mesh& mesh_;
  FlowMaterial material_;
  SurfaceMicrophoneSettings settings_;
  std::vector<Facet> facets_;
  std::vector<fem::Point> middles_, areas_;
  double longest_edge_ = 0;
};

}  // namespace vocalis::coupling
