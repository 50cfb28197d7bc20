#pragma once

#include "coupling/analogies/analogy.hpp"

namespace vocalis::coupling {

/// What the viscous force ν Δu = -ν curl ω of an incompressible flow is to sound. In the bulk it has no divergence, so
/// its load is one of the walls alone (by div(ω × ∇φ) = ∇φ·curl ω):
///
///   load_k = -∫_fluid ν curl ω·∇φ_k dx = -∫_walls ν (n × ω)·∇φ_k ds,
///
/// n out of the fluid, n × ω = (∇u)ᵀn - ∂n u, which is along the wall, so that its ∇φ is, too. The load has no sum; its
/// first moment is ∫ ν ω × n ds, along a wall at rest the friction over ρ. Where the fluid ends inside the air nothing
/// stands, as momentum goes on. (Howe 2003, Theory of Vortex Sound, has the same surface term in the force on a body
/// and its compact sound.) ω is the mean over each facet of that in its cell: exact for velocities of both degrees.
/// Facets of cells in contact, or with a silent vertex, are left out.
///
/// velocity  (vertices, d) of the flow at one end of the step [m/s]
/// of_edges  (edges, d) in their middles; empty: not known
void add_wall_friction(const FlowView& flow, const AnalogyMedium& medium, const std::vector<double>& velocity,
                       const std::vector<double>& of_edges, fem::Load& load);

}  // namespace vocalis::coupling
