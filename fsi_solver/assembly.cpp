#include "fsi_solver/assembly.hpp"

#include <algorithm>

#include "fsi_solver/tractions.hpp"

namespace vocalis::fsi {

Assembly::Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
                   const Prescribed& prescribed, MeshMotion* motion)
    : continuum_(continuum),
      settings_(settings),
      conditions_(conditions),
      fields_(continuum, settings, conditions, prescribed, motion),
      stabilisation_(*continuum.mesh),
      momentum_(continuum.velocity_space, continuum.mesh->dimension),
      mass_(continuum.pressure_space, 1),
      slope_(continuum.pressure_space, continuum.mesh->dimension) {
  find_held_rows();
  const int d = continuum.mesh->dimension;
  const int count = (d + 1) * (2 * d + 1);
  matrix_ = std::make_unique<la::AssembledMatrix>(layout(), rows_of_cells(), count, held_rows_, true);
  cell_matrices_.resize(static_cast<std::size_t>(continuum.mesh->num_cells()) * count * count);
}

void Assembly::find_held_rows() {
  const mesh::Mesh& mesh = *continuum_.mesh;
  for (const PrescribedComponent& entry : conditions_.components) {
    if (entry.vertex < mesh.vertices.num_owned) held_rows_.push_back(entry.vertex * mesh.dimension + entry.component);
  }
  // Fluid between walls alone: the pressure is known up to a constant, its first unknown is set to 0.
  const base::IndexMap& pressures = continuum_.pressure_space.dofs;
  if (continuum_.has_fluid && !continuum_.has_solid && !conditions_.sets_pressure_level && pressures.offset == 0 &&
      pressures.num_owned > 0) {
    held_rows_.push_back(layout().start(1));
  }
}

/// Global rows of each cell's unknowns in the order of CellUnknowns; -1 where a cell has no pressure.
std::vector<PetscInt> Assembly::rows_of_cells() const {
  const mesh::Mesh& mesh = *continuum_.mesh;
  const int d = mesh.dimension;
  std::vector<PetscInt> rows;
  rows.reserve(static_cast<std::size_t>(mesh.num_cells()) * (d + 1) * (2 * d + 1));
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto dofs = continuum_.pressure_space.dofs_of(cell);
    for (const std::int32_t vertex : mesh.vertices_of(cell)) {
      for (int k = 0; k < d; ++k) rows.push_back(layout().global(0, vertex, k));
    }
    for (const std::int32_t dof : dofs) rows.push_back(dof < 0 ? -1 : layout().global(1, dof, 0));
    for (const std::int32_t dof : dofs) {
      for (int k = 0; k < d; ++k) rows.push_back(dof < 0 ? -1 : layout().global(2, dof, k));
    }
  }
  return rows;
}

void Assembly::begin_step(const State& state, const Stage& stage, Vec unknowns) {
  fields_.begin_step(state, stage, unknowns);
  fields_.follow(unknowns);
  const fem::Field gradient = continuum_.mesh->dimension == 2
                                  ? stabilise<2>(fields_, continuum_, settings_, stabilisation_)
                                  : stabilise<3>(fields_, continuum_, settings_, stabilisation_);
  const la::OwnedValues values(unknowns);
  layout().copy_owned_to_system(2, gradient.values, values.data());
}

ResidualSize Assembly::residual(Vec unknowns, Vec result) {
  fields_.follow(unknowns);
  fields_.find_forces();
  for (fem::Load* load : {&momentum_, &mass_, &slope_}) std::fill(load->values.begin(), load->values.end(), 0.0);
  ResidualSums sums(continuum_.labels());
  if (continuum_.mesh->dimension == 2) {
    sum_cells<2>(sums);
    sum_tractions<2>(sums);
  } else {
    sum_cells<3>(sums);
    sum_tractions<3>(sums);
  }
  sum_over_ranks(sums);
  const ResidualSize size = sums.total(continuum_.mesh->comm);
  const la::OwnedValues values(result);
  layout().copy_owned_to_system(0, momentum_.values, values.data());
  layout().copy_owned_to_system(1, mass_.values, values.data());
  layout().copy_owned_to_system(2, slope_.values, values.data());
  for (const PetscInt row : held_rows_) values[row] = 0;
  return size;
}

template <int D>
void Assembly::sum_cells(ResidualSums& sums) {
  using Unknowns = CellUnknowns<D>;
  const mesh::Mesh& mesh = *continuum_.mesh;
  CellInput<D> in{};
  CellResidual<D> out{};
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const std::int32_t solid = continuum_.cell_solid[cell];
    fields_.gather(cell, in);
    const CellStabilisation<D> stabilisation = stabilisation_.of_cell<D>(cell);
    if (solid < 0) {
      if (!(in.geometry.measure > 0)) sums.mark_inverted();
      fluid_residual<D>(in, stabilisation, settings_.viscosity, out);
    } else if (!solid_residual<D>(in, stabilisation, continuum_.elasticity[solid],
                                  continuum_.solids[solid].incompressible, stabilisation_.recovery[cell], out)) {
      sums.mark_inverted();
      continue;
    }
    const auto vertices = mesh.vertices_of(cell);
    const auto dofs = continuum_.pressure_space.dofs_of(cell);
    for (int a = 0; a <= D; ++a) {
      const int label = 1 + continuum_.vertex_solid[vertices[a]];
      double* force = momentum_.at(vertices[a]);
      sums.add_term(ResidualSums::momentum, label, out.momentum_size);
      for (int k = 0; k < D; ++k) {
        const double value = out.values[Unknowns::velocity(a, k)];
        force[k] += value;
        sums.add_term(ResidualSums::momentum, label, value);
      }
      if (dofs[a] < 0) continue;
      mass_.values[dofs[a]] += out.values[Unknowns::pressure(a)];
      sums.add_term(ResidualSums::mass, 1 + solid, out.mass_size);
      sums.add_term(ResidualSums::projection, 1 + solid, out.gradient_size);
      for (int k = 0; k < D; ++k) slope_.at(dofs[a])[k] += out.values[Unknowns::gradient(a, k)];
    }
  }
}

template <int D>
void Assembly::sum_tractions(ResidualSums& sums) {
  CellInput<D> in{};
  for (const TractionFacet& facet : conditions_.tractions) {
    const FlowBoundary& boundary = conditions_.boundaries[facet.boundary];
    fields_.gather(facet.cell, in);
    const double pressure = boundary.pressure * ramp(boundary, fields_.stage_time());
    const double inflow = backflow<D>(in, facet.index, backflow_weight(boundary, settings_.backflow_stabilisation));
    const Corners<D> forces = traction<D>(in, facet.index, pressure, inflow);
    const auto vertices = continuum_.mesh->vertices_of(facet.cell);
    for (int a = 0; a <= D; ++a) {
      if (a == facet.index) continue;
      for (int k = 0; k < D; ++k) {
        momentum_.at(vertices[a])[k] += forces[a][k];
        sums.add_term(ResidualSums::momentum, 1 + continuum_.vertex_solid[vertices[a]], forces[a][k]);
      }
    }
  }
}

/// Makes the residual whole at its owners, where essential values leave none, and adds up its squares.
void Assembly::sum_over_ranks(ResidualSums& sums) {
  const int d = continuum_.mesh->dimension;
  momentum_.add_to_owners();
  mass_.add_to_owners();
  slope_.add_to_owners();
  for (const PetscInt row : held_rows_) {
    if (row < layout().start(1)) {
      momentum_.values[row] = 0;
    } else {
      mass_.values[row - layout().start(1)] = 0;
    }
  }
  for (std::int32_t v = 0; v < continuum_.mesh->vertices.num_owned; ++v) {
    const int label = 1 + continuum_.vertex_solid[v];
    for (int k = 0; k < d; ++k) sums.add_entry(ResidualSums::momentum, label, momentum_.at(v)[k]);
  }
  for (std::int32_t dof = 0; dof < continuum_.pressure_space.dofs.num_owned; ++dof) {
    const int label = continuum_.pressure_space.dof_label[dof];
    sums.add_entry(ResidualSums::mass, label, mass_.values[dof]);
    for (int k = 0; k < d; ++k) sums.add_entry(ResidualSums::projection, label, slope_.at(dof)[k]);
  }
}

void Assembly::jacobian() {
  if (continuum_.mesh->dimension == 2) {
    sum_jacobian<2>();
  } else {
    sum_jacobian<3>();
  }
  matrix_->assemble(cell_matrices_);
}

template <int D>
void Assembly::sum_jacobian() {
  constexpr std::size_t entries = CellUnknowns<D>::count * CellUnknowns<D>::count;
  const Stage& stage = fields_.stage();
  CellInput<D> in{};
  for (std::int32_t cell = 0; cell < continuum_.mesh->num_cells(); ++cell) {
    const std::int32_t solid = continuum_.cell_solid[cell];
    fields_.gather(cell, in);
    const CellStabilisation<D> stabilisation = stabilisation_.of_cell<D>(cell);
    double* matrix = cell_matrices_.data() + cell * entries;
    if (solid < 0) {
      fluid_jacobian<D>(in, stabilisation, settings_.viscosity, stage, matrix);
    } else {
      solid_jacobian<D>(in, stabilisation, continuum_.elasticity[solid], continuum_.solids[solid].incompressible,
                        stabilisation_.recovery[cell], stage, matrix);
    }
  }
  for (const TractionFacet& facet : conditions_.tractions) {
    const double weight = backflow_weight(conditions_.boundaries[facet.boundary], settings_.backflow_stabilisation);
    if (weight == 0) continue;
    fields_.gather(facet.cell, in);
    const double inflow = backflow<D>(in, facet.index, weight);
    add_traction_jacobian<D>(facet.index, inflow, stage, cell_matrices_.data() + facet.cell * entries);
  }
}

}  // namespace vocalis::fsi
