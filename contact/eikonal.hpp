#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "contact/walls.hpp"
#include "core/fem/field.hpp"
#include "core/la/assembled_matrix.hpp"
#include "core/la/solve.hpp"

namespace vocalis::contact {

struct EikonalSettings {
  double viscosity = 0.5;   ///< ε over the length of a cell along ∇D; a central scheme needs one half
  int corrections = 2;      ///< solves more, each with the viscosity's defect from the last
  double tolerance = 1e-8;  ///< change of a Newton step over the largest distance
  int largest_iterations = 60;
};

struct EikonalReport {
  bool converged = false;
  int iterations = 0;         ///< of Newton
  int linear_iterations = 0;  ///< over all
  std::string reason;         ///< empty when converged
};

/// Distance from the marked dofs as the solution of the Eikonal equation with artificial viscosity, P1:
///
///   ∫ (|∇D| - 1) q + ε ∇D·∇q = 0 for all q,   D = 0 at the marked dofs,   ε = viscosity times the cell's length,
///
/// by Newton's method (which for this convex equation is policy iteration). First order in the length of cells. On
/// planes of symmetry and where D falls outwards ∂D/∂n = 0; where it grows, the viscosity's flux leaves through the
/// boundary, so that D keeps its slope there. Source: Degirmenci 2018, Algorithm 2, steps 2 and 5 (stabilised cG(1)).
///
/// A correction solves the same equation with the source ∫ ε n·∇(θ q), n = ∇D/|∇D| and ε of the last solution: where
/// θ = 1, off the medial axis, of the viscosity remains ε (∇D - n), which goes with the residual |∇D| - 1; where θ = 0
/// all of it stays. Source: Stetter 1978, Numer. Math. 29, 425 (defect correction).
class Eikonal {
 public:
  /// `space` is P1 and must outlive the solver. Collective.
  explicit Eikonal(const fem::Space& space);

  /// coordinates  (vertices, dimension) [m], ghosts current
  /// is_zero      (dofs) where D = 0, ghosts current; at least one on some rank
  /// planes       of symmetry, on the boundary
  /// smoothness   (dofs) θ, ghosts current; empty: no correction
  /// distance     [m] on entry a starting guess, or all zero: then one is found from Poisson's equation (Tucker 2003,
  ///              J. Comput. Phys. 190, 229, eq. 8); for a correction the last solution. On return the solution, ghosts
  ///              current
  /// Collective.
  EikonalReport solve(std::span<const double> coordinates, std::span<const char> is_zero,
                      std::span<const SymmetryPlane> planes, const EikonalSettings& settings,
                      std::span<const double> smoothness, fem::Field& distance);

 private:
  struct CellState {
    std::array<double, 3> slope = {0, 0, 0}, direction = {0, 0, 0};
    double length = 0, viscosity = 1;
  };
  template <int D>
  void compute_cells(std::span<const double> coordinates);
  void find_open_facets(std::span<const double> coordinates, std::span<const SymmetryPlane> planes);
  CellState state_of(std::int32_t cell, const fem::Field* distance, double viscosity) const;
  std::array<double, 12> test_gradients(std::int32_t cell, const CellState& state) const;
  void compute_source(const fem::Field& distance, double viscosity, std::span<const double> smoothness);
  void assemble(const fem::Field* distance, double viscosity, std::span<const char> is_zero, Vec right_hand_side);
  void start(std::span<const char> is_zero, fem::Field& distance, EikonalReport& report);
  la::SolveReport solve_linear(Vec right_hand_side, fem::Field& solution);

  const fem::Space* space_;
  la::SystemLayout layout_;
  std::vector<double> gradients_;  ///< (cells, dimension + 1, dimension) [1/m]
  std::vector<double> measures_;   ///< (cells) [m^2, m^3]
  std::vector<char> is_open_;      ///< (cells, dimension + 1)
  std::vector<double> source_;     ///< (dofs) of the correction, of a rank's own cells
  std::vector<double> values_;
  std::vector<PetscInt> constrained_;  ///< owned positions where D = 0, in `matrix_`
  std::unique_ptr<la::AssembledMatrix> matrix_;
  la::PetscLinearSolver solver_;
};

}  // namespace vocalis::contact
