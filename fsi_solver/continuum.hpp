#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/fem/field.hpp"
#include "core/mesh/facets.hpp"
#include "core/mesh/mesh.hpp"
#include "fsi_solver/cells/cell_batches.hpp"
#include "fsi_solver/cells/constitutive.hpp"
#include "fsi_solver/settings.hpp"

namespace vocalis::fsi {

/// Which cells are what, and the spaces on them. The mesh is the reference configuration and must outlive this.
struct Continuum {
  static constexpr std::int32_t fluid = -1;

  const mesh::Mesh* mesh = nullptr;
  std::vector<SolidMaterial> solids;
  std::vector<Elasticity> elasticity;       ///< of each solid
  std::vector<std::int32_t> cell_solid;     ///< (owned cells) index in `solids`, or `fluid`
  std::int32_t contact = -2;                ///< index in `solids` of the contact medium; -2: there is none
  std::vector<double> closing_points;       ///< (owned cells, velocity nodes, dimension) [m] where contact cells have
                                            ///< closed, which is their reference; empty without a contact medium
  std::vector<double> contact_normals;      ///< (owned cells, dimension) unit normal of the plane of contact in that
                                            ///< reference; empty with full friction
  std::vector<std::int32_t> vertex_solid;   ///< (vertices) the last of the solids that have this vertex, or `fluid`
  bool has_fluid = false;                   ///< on any rank
  bool has_solid = false;                   ///< on any rank
  fem::Space vertex_space;                  ///< P1 on all cells; its dofs are the vertices
  fem::Space velocity_space;                ///< P1 or P2 on all cells
  fem::Space pressure_space;                ///< P1; label 0 in the fluid, 1 + i in an incompressible solid i
  std::vector<std::int32_t> dof_solid;      ///< (velocity dofs) the last of the solids that have it, or `fluid`
  std::vector<std::int32_t> vertex_to_dof;  ///< (vertices) dof of the velocity there
  std::vector<double> reference_points;     ///< (velocity dofs, dimension) [m], on the true curve of a boundary
  CellBatches batches;                      ///< of all owned cells

  /// Label of the pressure of a solid or the fluid: contact cells keep the fluid's.
  int pressure_label(std::int32_t solid) const { return solid == contact ? 0 : 1 + solid; }
  int labels() const { return 1 + static_cast<int>(solids.size()); }
  bool has_pressure(std::int32_t cell) const { return cell_solid[cell] < 0 || solids[cell_solid[cell]].incompressible; }
};

/// Collective. Throws UserError if a solid's region is not in the mesh, or is named twice.
Continuum make_continuum(const mesh::Mesh& mesh, const FlowSettings& settings);

/// Makes these fluid cells contact cells, and all others what they are by their region. Those that were none before
/// take the given places of the velocity's dofs as their reference. Nothing else may rely on which cells are fluid.
///
/// in_contact  (owned cells); solid cells must not be among them
/// points      (velocity dofs, dimension) [m], ghosts current
/// normals     (owned cells, dimension) of unit length in contact cells; unused with full friction
/// Collective.
void set_contact(Continuum& continuum, std::span<const char> in_contact, std::span<const double> points,
                 std::span<const double> normals);

/// Whether each local dof of a space lies on one of the facets, on any rank. Collective.
std::vector<std::int32_t> mark_dofs(const fem::Space& space, const std::vector<mesh::NamedFacet>& facets);

/// The values of a field on the velocity's space at the vertices, on the space of the vertices.
fem::Field at_vertices(const Continuum& continuum, const fem::Field& field);

/// Smallest quality (see mesh::quality) of the fluid cells, as if straight, with their vertices displaced; 1 without
/// fluid. The displacement is on the space of the vertices, ghosts current. Collective.
double smallest_fluid_quality(const Continuum& continuum, const fem::Field& displacement);

}  // namespace vocalis::fsi
