#include "fsi_solver/continuum.hpp"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "core/mesh/geometry.hpp"

namespace vocalis::fsi {

namespace {

/// The last of the solids that have each dof or vertex. Dofs of a cell come vertices first.
std::vector<std::int32_t> solid_of(const Continuum& continuum, const fem::Space& space) {
  std::vector<std::int32_t> result(space.num_dofs(), Continuum::fluid);
  for (std::int32_t cell = 0; cell < continuum.mesh->num_cells(); ++cell) {
    for (const std::int32_t dof : space.dofs_of(cell)) result[dof] = std::max(result[dof], continuum.cell_solid[cell]);
  }
  space.halo.max_to_owners(result);
  space.halo.copy_to_ghosts(result);
  return result;
}

/// All that follows from which cell is what.
void sort_by_kind(Continuum& continuum) {
  continuum.dof_solid = solid_of(continuum, continuum.velocity_space);
  continuum.vertex_solid = solid_of(continuum, continuum.vertex_space);
  std::vector<std::int32_t> all(continuum.mesh->num_cells());
  std::iota(all.begin(), all.end(), 0);
  continuum.batches = make_batches(all, continuum.cell_solid, continuum.velocity_space, continuum.pressure_space);
}

std::vector<std::int32_t> find_vertex_dofs(const Continuum& continuum) {
  const fem::Space& space = continuum.velocity_space;
  std::vector<std::int32_t> vertex_to_dof(continuum.mesh->num_vertices(), -1);
  for (std::int32_t dof = 0; dof < space.num_dofs(); ++dof) {
    if (space.dof_vertex[dof] >= 0) vertex_to_dof[space.dof_vertex[dof]] = dof;
  }
  return vertex_to_dof;
}

/// The contact medium is the last of the solids, in no cell yet; its pressure is the fluid's.
void add_contact_medium(Continuum& continuum, const FlowSettings& settings) {
  SolidMaterial medium;
  medium.incompressible = true;
  medium.density = settings.density;
  medium.young_modulus = settings.contact->young_modulus;
  medium.damping = settings.contact->damping;
  continuum.contact = static_cast<std::int32_t>(continuum.solids.size());
  continuum.solids.push_back(medium);
  continuum.elasticity.push_back(elasticity(medium));
  continuum.elasticity.back().slides = settings.contact->friction == Friction::none;
  if (continuum.elasticity.back().slides) {
    continuum.elasticity.back().film = settings.contact->film_viscosity;
    continuum.contact_normals.assign(static_cast<std::size_t>(continuum.mesh->num_cells()) * continuum.mesh->dimension,
                                     0.0);
  }
  continuum.closing_points.assign(static_cast<std::size_t>(continuum.mesh->num_cells()) *
                                      continuum.velocity_space.dofs_per_cell * continuum.mesh->dimension,
                                  0.0);
}

}  // namespace

Continuum make_continuum(const mesh::Mesh& mesh, const FlowSettings& settings) {
  Continuum result;
  result.mesh = &mesh;
  result.solids = settings.solids;
  std::vector<std::int32_t> solid_of_region(mesh.region_names.size(), Continuum::fluid);
  for (std::size_t i = 0; i < settings.solids.size(); ++i) {
    const SolidMaterial& solid = settings.solids[i];
    const int region = mesh::index_of(mesh.region_names, solid.region);
    if (region < 0) {
      throw base::UserError("a solid must name a region of the mesh", solid.region,
                            base::did_you_mean(solid.region, mesh.region_names));
    }
    if (solid_of_region[region] >= 0) {
      throw base::UserError("a region has one material", solid.region + " twice", "remove one of them");
    }
    solid_of_region[region] = static_cast<std::int32_t>(i);
    result.elasticity.push_back(elasticity(solid));
  }
  const std::int32_t cells = mesh.num_cells();
  result.cell_solid.resize(cells);
  std::vector<std::int32_t> label(cells), in_fluid(cells);
  for (std::int32_t cell = 0; cell < cells; ++cell) {
    const std::int32_t solid = solid_of_region[mesh.cell_region[cell]];
    result.cell_solid[cell] = solid;
    in_fluid[cell] = solid < 0;
    label[cell] = result.has_pressure(cell) ? solid + 1 : -1;
  }
  const auto here = [&](bool fluid) {
    return static_cast<std::int32_t>(std::count(in_fluid.begin(), in_fluid.end(), fluid ? 1 : 0));
  };
  result.has_fluid = base::largest(mesh.comm, here(true)) > 0;
  result.has_solid = base::largest(mesh.comm, here(false)) > 0;
  result.vertex_space = fem::lagrange(mesh, 1);
  result.velocity_space = fem::lagrange(mesh, settings.elements == Elements::p1p1 ? 1 : 2);
  result.pressure_space = fem::lagrange(mesh, 1, label);
  result.reference_points = fem::dof_points(result.velocity_space);
  result.vertex_to_dof = find_vertex_dofs(result);
  if (settings.contact && result.has_fluid) add_contact_medium(result, settings);
  sort_by_kind(result);
  return result;
}

void set_contact(Continuum& continuum, std::span<const char> in_contact, std::span<const double> points,
                 std::span<const double> normals) {
  const int d = continuum.mesh->dimension, nodes = continuum.velocity_space.dofs_per_cell;
  for (std::int32_t cell = 0; cell < continuum.mesh->num_cells(); ++cell) {
    std::int32_t& solid = continuum.cell_solid[cell];
    if (!in_contact[cell]) {
      if (solid == continuum.contact) solid = Continuum::fluid;
      continue;
    }
    assert(solid == Continuum::fluid || solid == continuum.contact);
    if (solid == continuum.contact) continue;
    solid = continuum.contact;
    const auto dofs = continuum.velocity_space.dofs_of(cell);
    for (int a = 0; a < nodes; ++a) {
      std::copy_n(points.data() + static_cast<std::size_t>(dofs[a]) * d, d,
                  continuum.closing_points.data() + (static_cast<std::size_t>(cell) * nodes + a) * d);
    }
    if (continuum.contact_normals.empty()) continue;
    const std::size_t first = static_cast<std::size_t>(cell) * d;
    assert(normals.size() == continuum.contact_normals.size());
    std::copy_n(normals.data() + first, d, continuum.contact_normals.data() + first);
  }
  sort_by_kind(continuum);
}

std::vector<std::int32_t> mark_dofs(const fem::Space& space, const std::vector<mesh::NamedFacet>& facets) {
  const mesh::Mesh& mesh = *space.mesh;
  const auto edges = mesh::edges_of_cell(mesh.dimension);
  std::vector<std::int32_t> marks(space.num_dofs(), 0);
  for (const mesh::NamedFacet& facet : facets) {
    const auto dofs = space.dofs_of(facet.cell);
    for (int a = 0; a < space.dofs_per_cell; ++a) {
      const bool is_corner = a <= mesh.dimension;
      const bool is_on_it = is_corner ? a != facet.index
                                      : edges[a - mesh.dimension - 1][0] != facet.index &&
                                            edges[a - mesh.dimension - 1][1] != facet.index;
      if (is_on_it && dofs[a] >= 0) marks[dofs[a]] = 1;
    }
  }
  space.halo.max_to_owners(marks);
  space.halo.copy_to_ghosts(marks);
  return marks;
}

fem::Field at_vertices(const Continuum& continuum, const fem::Field& field) {
  fem::Field result(continuum.vertex_space, field.components);
  for (std::size_t vertex = 0; vertex < continuum.vertex_to_dof.size(); ++vertex) {
    std::copy_n(field.at(continuum.vertex_to_dof[vertex]), field.components,
                result.at(static_cast<std::int32_t>(vertex)));
  }
  return result;
}

double smallest_fluid_quality(const Continuum& continuum, const fem::Field& displacement) {
  std::vector<double> coordinates = continuum.mesh->coordinates;
  for (std::size_t i = 0; i < coordinates.size(); ++i) coordinates[i] += displacement.values[i];
  double lowest = 1;
  for (std::int32_t cell = 0; cell < continuum.mesh->num_cells(); ++cell) {
    const std::int32_t solid = continuum.cell_solid[cell];
    if (solid >= 0 && solid != continuum.contact) continue;
    lowest = std::min(lowest, mesh::quality(*continuum.mesh, cell, coordinates));
  }
  return base::smallest(continuum.mesh->comm, lowest);
}

}  // namespace vocalis::fsi
