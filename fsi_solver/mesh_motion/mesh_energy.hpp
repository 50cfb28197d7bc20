#pragma once

#include <vector>

#include "fsi_solver/continuum.hpp"

namespace vocalis::fsi {

/// The elastic energy of the fluid's mesh, the sum of w W(F) over its cells: W is that of DistortionEnergy and
/// w = volume (mean volume / volume)^stiffening as in MeshMotion, with which it agrees to second order in the
/// displacement. Displacements are fields of degree 1 on the vertices, ghosts current.
class MeshEnergy {
 public:
  /// What a step does to the cells.
  struct Change {
    double energy = 0;  ///< of the whole mesh, afterwards - before; infinite if a cell is inverted
    double volume = 1;  ///< smallest volume afterwards / before of a cell
    double size = 0;    ///< largest |δF F⁻¹| of a cell
  };

  /// Collective.
  MeshEnergy(const Continuum& continuum, double stiffening);

  /// Smallest volume of a cell relative to the reference; infinite without cells. Collective.
  double smallest_volume(const fem::Field& displacement) const;
  /// No cell may be inverted before. Collective.
  Change change(const fem::Field& before, const fem::Field& after) const;
  /// Derivatives by the displacements of owned vertices. No cell may be inverted. Collective.
  fem::Load gradient(const fem::Field& displacement) const;
  /// Second derivatives, (cells, n, n), n = (dimension + 1) dimension, 0 in solids; `curvature` as in
  /// DistortionEnergy::add_hessian. No cell may be inverted.
  std::vector<double> hessian(const fem::Field& displacement, bool curvature) const;

 private:
  template <int D, class Visit>
  void visit(const fem::Field& displacement, Visit visit) const;

  const mesh::Mesh& mesh_;
  std::vector<double> weight_;  ///< (cells) w [m^d]; 0 in solids
};

}  // namespace vocalis::fsi
