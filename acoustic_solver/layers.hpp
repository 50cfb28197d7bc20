#pragma once

#include <array>
#include <span>
#include <vector>

#include "acoustic_solver/layer_profile.hpp"
#include "acoustic_solver/state.hpp"

namespace vocalis::acoustic {

/// The terms that absorbing layers add to the wave equation. With s_i the damping along axis i, constant on each cell,
///
///   (1 / (ρ c²)) (ṗ + a p + b ρ ψ + g ρ w, q) + (∇ψ + φ, ∇q) + ... = ...,    ẇ = ψ,
///   φ̇_i + s_i φ_i = A_i ∂_i ψ + B_i ∂_i w                                     one vector a layer cell.
///
/// Perfectly matched: a = Σ s_i, b = Σ s_i s_j, g = s_x s_y s_z, A_i = s_j + s_k - s_i, B_i = s_j s_k; this is the wave
/// equation in the coordinates stretched by 1 + s_i / (iω), which no plane wave feels as a boundary. Sponge: p and u
/// are both damped by s = Σ s_i; a = s, b = g = 0, A_i = -s, B_i = 0. Source: Grote & Sim 2010, eqs. 2.16-2.18, written
/// for ψ; docs/theory.md, "Layers that absorb sound".
///
/// What a mesh of finite cells reflects where s changes is taken out: mass is a cell's mean and what varies about it,
///
///   (p, q) = |T| (p̄ q̄ + Σij C_ij ∂_i p ∂_j q),    C the covariance of the cell's points,
///
/// and only the mean is stretched with the cell, C is not. So a layer of cells of any damping has the impedance of the
/// mesh in front of it (Guddati & Lim 2006, for midpoint integration): a, b and g act on p̄ and ψ̄, ∂_i ψ in the equation
/// of φ becomes ∂_i ψ + C_ii ∂_i ṗ / (ρ c²), ∂_i w likewise ∂_i w + C_ii ∂_i p / (ρ c²), and s_k C_ij ∂_j p is damped.
///
/// Layers stand still. Sums over this rank's cells: the caller adds them to the owners.
class Layers {
 public:
  /// The geometry is that of the mesh, which must outlive the layers. Throws UserError. Collective.
  Layers(const mesh::Mesh& mesh, const AcousticSettings& settings);

  /// Whether there are any, on every rank alike.
  bool exist() const { return !sides_.empty(); }

  /// Whether w has an effect, on every rank alike.
  bool has_integral() const { return needs_integral_; }

  /// Gives φ and w their sizes, and 0 where they have another one.
  void prepare(Unknowns& unknowns) const;

  /// φ of each of this rank's cells, (cells, dimension), 0 outside of the layers; and back. For cells that get other
  /// numbers.
  std::vector<double> flux_of_cells(const Unknowns& unknowns) const;
  void take_flux(std::span<const double> of_cells, Unknowns& unknowns) const;

  /// Whether each of this rank's cells is damped.
  std::vector<std::int32_t> damped_cells() const;

  /// Whether no vertex of a layer's cell has a velocity, on any rank. Collective.
  bool stand_still(std::span<const double> velocity) const;

  /// What the layers add to (1 / beta) mass + (beta / ρ) stiffness, once φ, w and ψ at the stage are eliminated:
  /// 1 + a beta + b beta² + g beta³ times the mean mass, and 1 + (beta A_i + beta² B_i) / (1 + beta s_i) > 0 times the
  /// stiffness and the varying mass along axis i. beta = θ dt [s], see GeneralisedAlpha; values (cells, n, n).
  void add_system_values(double beta, std::vector<double>& values) const;

  /// Adds -(1 / (ρ c²)) (a p + b ρ ψ + g ρ w, q) - (φ, ∇q) at the stage, where `pressure` and `potential` are given
  /// with ghosts and φ and w follow from their values at the beginning.
  void add_forces(double beta, std::span<const double> pressure, std::span<const double> potential,
                  const Unknowns& beginning, std::span<double> sums) const;

  /// Moves φ and w of the unknowns, whose p is still that of the beginning, on to the stage, where p and ψ are given.
  void advance(double beta, std::span<const double> pressure, std::span<const double> potential,
               Unknowns& unknowns) const;

 private:
  struct Cell {
    std::int32_t cell = 0;
    double measure = 0;               ///< [m^2, m^3]
    double gradients[4][3] = {};      ///< of the P1 basis [1/m]
    double a = 0, b = 0, g = 0;       ///< [1/s], [1/s^2], [1/s^3]
    double decay[3] = {};             ///< s_i [1/s]
    double on_gradient[3] = {};       ///< A_i [1/s]
    double on_integral[3] = {};       ///< B_i [1/s^2]
    double moment[3][3] = {};         ///< C_ij / (ρ c²) as φ_i needs it [m^2/Pa]
    double damped_moment[3][3] = {};  ///< s_k C_ij / (ρ c²), i ≠ j ≠ k [m^2/(Pa s)]
  };
  template <int D>
  void measure_cell(Cell& cell) const;
  /// Gradients in a cell at the stage; that of ṗ is 0 where it is not set.
  struct Slopes {
    std::array<double, 3> pressure = {}, rate = {}, potential = {}, integral = {};
  };
  std::array<double, 3> slope(const Cell& cell, std::span<const double> values) const;
  /// φ at the stage.
  std::array<double, 3> flux(const Cell& cell, double beta, const double* before, const Slopes& at) const;
  std::vector<double> integral_at(double beta, std::span<const double> potential, const Unknowns& beginning) const;

  const mesh::Mesh* mesh_;
  double inverse_bulk_modulus_, density_;
  std::vector<LayerSide> sides_;
  std::vector<Cell> cells_;
  bool needs_integral_ = false;  ///< w has an effect
};

}  // namespace vocalis::acoustic
