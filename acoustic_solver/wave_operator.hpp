#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "acoustic_solver/boundaries.hpp"
#include "acoustic_solver/orthogonal_subscales.hpp"
#include "acoustic_solver/wall_branches.hpp"
#include "core/fem/space.hpp"

namespace vocalis::acoustic {

/// The integrals of the wave equation over P1 functions p, ψ on one geometry, boundary terms included:
///
///   mass          (1 / (ρ c²)) (p, q)          consistent: where a step is near h / c its dispersion and that of
///                                              Crank–Nicolson cancel in part
///   stiffness     (∇ψ, ∇q) + <ψ / R, q>_open; with velocity_elements = "P1" (P∇ψ, P∇q) instead of the first term
///   admittance    <µ p / (ρ c), q>_walls, open; with velocity_elements = "P1" also (τ / ρ) (P⊥∇p, P⊥∇q), τ = C h / c
///                                              of walls that yield the system holds that of its step, and
///                                              `YieldingWalls` what they do of themselves
///   convection    (1 / (ρ c²)) ((β - U)·∇p, q), and (β - U)·∇ψ at the vertices: β of the mesh, U of the medium
///
/// Functions that add leave the sums of each rank over its own cells: the caller adds them to the owners. Arrays have
/// one number a local vertex, ghosts current where they are read.
class WaveOperator {
 public:
  /// `space` is P1 on `mesh`; both must outlive the operator. The geometry is that of the mesh. Collective.
  WaveOperator(const mesh::Mesh& mesh, const fem::Space& space, const AcousticSettings& settings);

  /// Other coordinates, (vertices, dimension) [m]: recomputes the cells with a vertex that moved. Returns whether any
  /// moved on this rank. Not collective.
  bool set_geometry(std::span<const double> coordinates);

  /// Finds the cells in which `add_convection` and `potential_convection` integrate. (vertices, dimension) [m/s],
  /// ghosts current. Collective.
  ///
  /// of_mesh    β; empty: the mesh stands still
  /// of_medium  U; empty: the medium is at rest
  void set_velocity(std::span<const double> of_mesh, std::span<const double> of_medium = {});
  /// Whether U is anywhere, on any rank.
  bool flows() const { return flows_; }
  /// The largest |U| of this rank's vertices [m/s].
  double largest_flow_speed() const;

  /// (cells, n, n) values of  a mass + admittance + b stiffness  of P1/P0, a = 1 / (θ dt).
  void system_values(double a, double b, std::vector<double>& values) const;

  /// What velocities in P1 change in the product of that matrix with x; nothing if they are in P0. Collective.
  void add_subscales(double b, std::span<const double> x, std::span<double> sums) const;

  /// Collective, as are the next two.
  void add_stiffness(double factor, std::span<const double> potential, std::span<double> sums) const;
  /// The same of a function that is 0 at the vertices where β - U is.
  void add_convecting_stiffness(double factor, std::span<const double> potential, std::span<double> sums) const;
  void add_admittance(double factor, std::span<const double> pressure, std::span<double> sums) const;
  /// The part of `add_admittance` that open boundaries have.
  void add_open_admittance(double factor, std::span<const double> pressure, std::span<double> sums) const;
  /// <g, q> over the facets where the source enters. g [m/s]
  void add_flux(double g, std::span<double> sums) const;

  /// Adds (1 / (ρ c²)) (β·∇p, q), and of the flow what is adjoint to `potential_convection`, so that the energy of
  /// docs/theory.md, "Sound in a flow", stays: (D q, µ) with D = U·∇ at the vertices and µ = `momentum`, less
  /// (1 / (ρ c²)) <U·n p, q> on all facets but open ones. Collective if the medium flows.
  void add_convection(std::span<const double> pressure, std::span<const double> momentum, std::span<double> sums) const;
  /// (1 / (ρ c²)) (p, q) where the medium flows, ghosts current; empty where nothing flows. Collective.
  std::vector<double> momentum(std::span<const double> pressure) const;

  /// (β - U)·∇ψ at the vertices [m^2/s^2]: ∇ψ is the lumped L2 projection, but for its component normal to a moving
  /// wall, where a mean over cells on one side alone would be of first order, and ∂ψ/∂n = -u·n is known. Ghosts
  /// current. wall_velocities: `YieldingWalls::velocities`. Collective.
  void potential_convection(std::span<const double> potential, std::span<const double> pressure,
                            std::vector<double>& rates,
                            std::span<const std::vector<double>> wall_velocities = {}) const;

  /// Acoustic energy ½ p²/(ρ c²) + ½ ρ |∇ψ|², over all ranks [J; J/m in two dimensions]. Collective.
  double energy(std::span<const double> pressure, std::span<const double> potential) const;

  /// h [m] of this rank's smallest cell; infinite without cells. Looks at all of them.
  double smallest_length() const;
  /// Owned vertices with p = 0.
  const std::vector<std::int32_t>& released() const { return released_; }
  /// Local vertices, ghosts too, that are released and stand still in a flow: there ψ̇ = 0, and so p = ρ U·∇ψ.
  const std::vector<std::int32_t>& inlets() const { return inlets_; }
  /// Whether there are any on any rank.
  bool has_inlets() const { return has_inlets_; }
  std::span<const double> coordinates() const { return coordinates_; }
  const std::vector<BoundaryFacet>& facets() const { return facets_; }
  double inverse_bulk_modulus() const { return inverse_bulk_modulus_; }
  /// Of a cell [m^2, m^3].
  double measure(std::int32_t cell) const { return measures_[cell]; }
  /// Of the basis function of a cell's vertex [1/m].
  const double* gradient(std::int32_t cell, int vertex) const {
    return gradients_.data() + (static_cast<std::size_t>(cell) * (mesh_->dimension + 1) + vertex) * mesh_->dimension;
  }
  /// Of each boundary of the settings; empty where it does not yield.
  const std::vector<std::vector<WallBranch>>& wall_branches() const { return wall_branches_; }
  /// Weight of the pair (i, j) of a facet's vertices, measure / (d (d + 1)) (1 + δij).
  double facet_weight(const BoundaryFacet& facet) const;

 private:
  template <int D>
  const std::int32_t* corners(std::int32_t cell) const {
    return mesh_->cell_vertices.data() + static_cast<std::size_t>(cell) * (D + 1);
  }
  /// ∇ of a P1 function in a cell. Within loops: a call would pass the numbers through memory.
  template <int D>
  [[gnu::always_inline]] std::array<double, D> slope(std::int32_t cell, std::span<const double> values) const;
  template <int D>
  [[gnu::always_inline]] void add_stiffness_of_cell(std::int32_t cell, double factor, std::span<const double> potential,
                                                    std::span<double> sums) const;
  /// What is not of cells in P1/P0: of open boundaries, and of velocities in P1.
  void add_stiffness_of_rest(double factor, std::span<const double> potential, std::span<double> sums) const;
  template <int D>
  void system_values_of_cells(double a, double b, std::vector<double>& values) const;
  template <int D>
  void add_mesh_convection(std::span<const double> pressure, std::span<double> sums) const;
  template <int D>
  void add_flow_of_cells(std::span<const double> momentum, const std::vector<double>& around,
                         std::span<double> sums) const;
  /// Into rows of `columns` numbers a vertex: measure x ∇ψ over its cells with v, and their measure.
  template <int D>
  void add_slopes(std::span<const double> potential, int columns, std::span<double> sums) const;
  template <int D>
  void compute_cells(const std::vector<char>& vertex_moved);
  void add_facet_admittance(double factor, std::span<const double> pressure, std::span<double> sums,
                            bool open_only) const;
  void add_flow(std::span<const double> pressure, std::span<const double> momentum, std::span<double> sums) const;
  /// Measure of all cells around each vertex where the medium flows, ghosts current. Collective.
  std::vector<double> flow_measures() const;
  /// Measure times factor, and times τ / ρ if `damps`.
  std::vector<double> subscale_weights(double factor, bool damps) const;

  const mesh::Mesh* mesh_;
  const fem::Space* space_;
  double inverse_bulk_modulus_;                   ///< 1 / (ρ c²) [1/Pa]
  double density_;                                ///< ρ [kg/m^3]
  double subscale_time_;                          ///< τ / (ρ h) [m^2 s/kg]
  std::optional<OrthogonalSubscales> subscales_;  ///< velocities in P1
  std::vector<BoundaryFacet> facets_;
  std::vector<std::vector<WallBranch>> wall_branches_;
  std::vector<std::int32_t> released_;
  std::vector<double> coordinates_;  ///< (vertices, dimension) [m] of the integrals
  std::vector<double> gradients_;    ///< (cells, dimension + 1, dimension) of the P1 basis [1/m]
  std::vector<double> measures_;     ///< (cells) [m^2, m^3]
  std::vector<double> mesh_velocity_, medium_velocity_, velocity_;          ///< β, U, β - U, each maybe empty
  std::vector<std::int32_t> moving_cells_, flow_cells_, convecting_cells_;  ///< with a vertex of β, U, β - U
  std::vector<BoundaryFacet> moving_walls_;
  std::vector<std::int32_t> inlets_;
  bool flows_ = false, has_inlets_ = false;
};

template <int D>
inline std::array<double, D> WaveOperator::slope(std::int32_t cell, std::span<const double> values) const {
  const std::int32_t* vertices = corners<D>(cell);
  const double* g = gradient(cell, 0);
  std::array<double, D> result = {};
  for (int i = 0; i <= D; ++i) {
    for (int k = 0; k < D; ++k) result[k] += values[vertices[i]] * g[i * D + k];
  }
  return result;
}

}  // namespace vocalis::acoustic
