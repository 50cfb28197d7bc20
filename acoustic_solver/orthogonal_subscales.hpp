#pragma once

#include <span>
#include <vector>

#include "core/fem/space.hpp"

namespace vocalis::acoustic {

/// What tells equal-order P1/P1 from P1/P0, for x in P1:
///
///   w (P⊥∇x, P⊥∇q) = w (∇x, ∇q) - w (P∇x, P∇q),   P⊥ = 1 - P,   P∇x: the projection of ∇x to continuous P1.
///
/// With u = -P∇ψ the stiffness of P1/P1 is that of P1/P0 without this term (w = 1); with w = τ / ρ the same term on p
/// is the orthogonal subscale of Badia, Codina & Espinoza 2014, which damps what P does not see. The projection uses
/// the consistent mass M, its inverse as the series Σ (1 - D⁻¹M)ⁿ D⁻¹ about the lumped D: the terms are positive, so
/// that the bilinear form stays symmetric and positive semi-definite wherever the series ends.
class OrthogonalSubscales {
 public:
  /// Both must outlive the object.
  OrthogonalSubscales(const mesh::Mesh& mesh, const fem::Space& space) : mesh_(&mesh), space_(&space) {}

  /// Adds the form of x with each basis function to `sums`, over this rank's cells. The projection is weighed by w.
  ///
  /// gradients  (cells, dimension + 1, dimension) of the P1 basis [1/m]
  /// weights    (cells) measure times w
  /// values     x at the vertices, ghosts current
  /// Collective.
  void add(std::span<const double> gradients, std::span<const double> weights, std::span<const double> values,
           std::span<double> sums) const;

 private:
  /// P of a field that is constant in each cell, (cells, dimension): (vertices, dimension), ghosts current. Collective.
  std::vector<double> project(std::span<const double> slopes, std::span<const double> weights) const;

  const mesh::Mesh* mesh_;
  const fem::Space* space_;
};

}  // namespace vocalis::acoustic
