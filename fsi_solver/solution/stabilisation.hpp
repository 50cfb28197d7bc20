#pragma once

#include <vector>

#include "fsi_solver/solution/stage_fields.hpp"

namespace vocalis::fsi {

/// Stabilisation of every cell for one step, from the accepted state: τ, τ₂, the advecting velocity and the projection
/// of (c·∇)v at the stage by extrapolation from the last two steps, so that it is second order in time and needs no
/// memory.
///
///   1/τ = ρ Σ_a |c·∇φ_a| + µ Σ_a |∇φ_a|²   in the stream,   1/τ = ρ |c| (Σ_a |∇φ_a|²)^½ + µ Σ_a |∇φ_a|² of the
///   pressure (solids: c → c_s = (µs / ρs)^½, µ → η),   τ₂ = µ + ρ |c| / (Σ_a |∇φ_a|²)^½
///
/// with φ_a of the corners, whose sums are 2 ρ |c| / h and 4 µ / h² of a regular triangle; with degree 2, h is half of
/// the cell. No dt enters, so nothing collapses as dt → 0.
/// Source: Codina 2000, Comput. Meth. Appl. Mech. Eng. 190, 1579; 2008, Appl. Numer. Math. 58, 264 (term by term).
struct Stabilisation {
  explicit Stabilisation(const Continuum& continuum);

  template <int D>
  CellStabilisation<D> of_batch(const CellBatches& batches, std::size_t batch) const;

  std::vector<double> pressure, stream, divergence;  ///< (cells)
  std::vector<double> recovery;                      ///< (cells) κ of incompressible solids [1/s]
  std::vector<double> advection;                     ///< (cells, dimension)
  fem::Field projection;                             ///< of (c·∇)v, at the vertices; ghosts current
  double of_pressure = 1;                            ///< 0: the pressure has none
};

/// Whether there is anything to stabilise: not with P2P1 if the streamlines are left alone, and no solid is
/// incompressible.
bool needs_stabilisation(const Continuum& continuum, const FlowSettings& settings);

/// Renews the stabilisation of every cell from the fields as they are. Returns the τ-weighted lumped projection π of
/// their pressure gradient [Pa/m], on the pressure's space, ghosts current (P1P1 only; else zero). Collective.
template <int D, int Degree>
fem::Field stabilise(const StageFields& fields, const Continuum& continuum, const FlowSettings& settings,
                     Stabilisation& stabilisation);

}  // namespace vocalis::fsi
