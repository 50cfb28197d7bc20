#pragma once

#include <cstdint>
#include <vector>

#include "core/fem/field.hpp"
#include "core/mesh/mesh.hpp"
#include "fsi_solver/constitutive.hpp"
#include "fsi_solver/settings.hpp"

namespace vocalis::fsi {

/// Which cells are what, and the spaces on them. The mesh is the reference configuration and must outlive this.
struct Continuum {
  static constexpr std::int32_t fluid = -1;

  const mesh::Mesh* mesh = nullptr;
  std::vector<SolidMaterial> solids;
  std::vector<Elasticity> elasticity;         ///< of each solid
  std::vector<std::int32_t> cell_solid;       ///< (owned cells) index in `solids`, or `fluid`
  std::vector<std::int32_t> vertex_solid;     ///< (vertices) the last of the solids that have this vertex, or `fluid`
  std::vector<std::int32_t> vertex_in_fluid;  ///< (vertices) whether a fluid cell has it, on any rank
  bool has_fluid = false;                     ///< on any rank
  bool has_solid = false;                     ///< on any rank
  fem::Space velocity_space;                  ///< P1 on all cells; its dofs are the vertices
  fem::Space pressure_space;                  ///< P1; label 0 in the fluid, 1 + i in an incompressible solid i

  int labels() const { return 1 + static_cast<int>(solids.size()); }
  bool has_pressure(std::int32_t cell) const { return cell_solid[cell] < 0 || solids[cell_solid[cell]].incompressible; }
};

/// Collective. Throws UserError if a solid's region is not in the mesh, or is named twice.
Continuum make_continuum(const mesh::Mesh& mesh, const FlowSettings& settings);

/// Smallest quality (see mesh::quality) of the fluid cells with their vertices at given coordinates,
/// (vertices, dimension) [m]; 1 without fluid. Collective.
double smallest_fluid_quality(const Continuum& continuum, const std::vector<double>& coordinates);

}  // namespace vocalis::fsi
