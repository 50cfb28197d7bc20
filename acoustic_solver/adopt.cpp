#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "acoustic_solver/acoustic_solver.hpp"
#include "acoustic_solver/discretisation.hpp"
#include "acoustic_solver/pockets.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "transfer/carry.hpp"
#include "transfer/fill.hpp"

namespace vocalis::acoustic {

namespace {

/// Vertices where ψ itself acts: of open spheres and layers. Collective.
std::vector<std::int32_t> bound_vertices(const mesh::Mesh& mesh, const WaveOperator& wave, const Layers& layers) {
  std::vector<std::int32_t> cells = layers.damped_cells();
  for (const BoundaryFacet& facet : wave.facets()) {
    if (facet.on_potential != 0) cells[facet.cell] = 1;
  }
  return mesh::mark_vertices_of_cells(mesh, cells);
}

/// Collective.
void require_layers_kept(const std::vector<std::int32_t>& is_damped, const transfer::StrippedMesh& before,
                         const transfer::StrippedMesh& after, const AcousticSettings& settings) {
  std::int32_t gone = 0;
  for (std::int32_t cell = 0; cell < before.mesh.num_cells(); ++cell) {
    if (is_damped[cell] && after.parent_to_cell[before.cell_to_parent[cell]] < 0) gone = 1;
  }
  if (base::largest(before.mesh.comm, gone) == 0) return;
  throw base::UserError(fmt::format("nothing closes in the absorbing layers of acoustic solver '{}'", settings.name),
                        "cells there came into contact", "make the layers thinner, or write contact_cells = \"keep\"");
}

/// Vertices of cells that both meshes have: at others no air has been all the time. Collective.
std::vector<std::int32_t> mark_kept_vertices(const transfer::StrippedMesh& before,
                                             const transfer::StrippedMesh& after) {
  std::vector<std::int32_t> is_kept(after.mesh.num_cells());
  for (std::int32_t cell = 0; cell < after.mesh.num_cells(); ++cell) {
    is_kept[cell] = before.parent_to_cell[after.cell_to_parent[cell]] >= 0;
  }
  return mesh::mark_vertices_of_cells(after.mesh, is_kept);
}

/// φ by the cells after, (cells, dimension): 0 in those that were not there.
std::vector<double> carry_flux(const std::vector<double>& flux, const transfer::StrippedMesh& before,
                               const transfer::StrippedMesh& after) {
  const int d = after.mesh.dimension;
  std::vector<double> carried(static_cast<std::size_t>(after.mesh.num_cells()) * d, 0.0);
  for (std::int32_t cell = 0; cell < after.mesh.num_cells(); ++cell) {
    const std::int32_t there = before.parent_to_cell[after.cell_to_parent[cell]];
    if (there < 0) continue;
    std::copy_n(flux.begin() + static_cast<std::ptrdiff_t>(there) * d, d,
                carried.begin() + static_cast<std::ptrdiff_t>(cell) * d);
  }
  return carried;
}

}  // namespace

Adoption AcousticSolver::adopt(const mesh::Mesh& parent, const transfer::StrippedMesh& before,
                               const transfer::StrippedMesh& after) {
  Discretisation& old = *discretisation_;
  assert(old.mesh == &before.mesh);
  require_layers_kept(old.layers.damped_cells(), before, after, settings_);
  old.wave.set_geometry(before.mesh.coordinates);
  Adoption adoption{.energy_before = energy()};
  auto next = std::make_unique<Discretisation>(after.mesh, settings_);
  const auto way = transfer::SharedVertices::between(parent, before, after);
  const std::vector<std::int32_t> is_kept = mark_kept_vertices(before, after);
  const auto carry = [&](const auto& values, int components = 1) {
    fem::Field from(old.space, components), to(next->space, components);
    from.values.assign(values.begin(), values.end());
    way.carry(from, to);
    return to;
  };
  const auto carry_and_fill = [&](const std::vector<double>& values) {
    fem::Field to = carry(values);
    transfer::fill(to, is_kept);
    return std::move(to.values);
  };
  State carried;
  carried.time = state_.time;
  carried.p = carry_and_fill(state_.p);
  carried.psi = carry_and_fill(state_.psi);
  carried.has_rates = state_.has_rates;
  if (state_.has_rates) {
    carried.rates.p = carry_and_fill(state_.rates.p);
    carried.rates.psi = carry_and_fill(state_.rates.psi);
  }
  const fem::Field names = carry(find_pockets(before.mesh));
  const fem::Field bound = carry(bound_vertices(before.mesh, old.wave, old.layers));
  PocketsBefore pockets{{names.values.begin(), names.values.end()}, {bound.values.begin(), bound.values.end()}};
  for (std::size_t v = 0; v < is_kept.size(); ++v) {
    if (!is_kept[v]) pockets.name[v] = -1;
  }
  join_pockets(pockets, next->wave, next->space, carried.psi);
  for (const auto& pressure : state_.earlier) carried.earlier.push_back(carry_and_fill(pressure));
  const auto carry_boundaries = [&](const Unknowns& from, Unknowns& to) {
    for (const std::int32_t v : next->wave.released()) to.p[v] = 0;
    next->space.halo.copy_to_ghosts(to.p);
    if (old.layers.exist()) {
      next->layers.take_flux(carry_flux(old.layers.flux_of_cells(from), before, after), to);
      next->layers.prepare(to);
      if (old.layers.has_integral()) to.layer_integral = carry_and_fill(from.layer_integral);
    }
    if (!old.walls.exist()) return;
    const int numbers = old.walls.numbers_a_vertex();
    fem::Field motion = carry(old.walls.motion_of_vertices(from), numbers);
    for (std::int32_t v = 0; v < after.mesh.num_vertices(); ++v) {
      if (!is_kept[v]) std::fill_n(motion.at(v), numbers, 0.0);
    }
    next->walls.take_motion(motion.values, to);
  };
  carry_boundaries(state_, carried);
  if (state_.has_rates) carry_boundaries(state_.rates, carried.rates);
  discretisation_ = std::move(next);
  state_ = std::move(carried);
  adoption.energy_after = energy();
  return adoption;
}

}  // namespace vocalis::acoustic
