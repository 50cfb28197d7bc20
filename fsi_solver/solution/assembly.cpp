#include "fsi_solver/solution/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/mpi.hpp"
#include "fsi_solver/cells/fluid_terms.hpp"
#include "fsi_solver/cells/solid_terms.hpp"
#include "fsi_solver/cells/tractions.hpp"

namespace vocalis::fsi {

namespace {

/// Σ over active lanes of the squares of some of a batch's values.
double squares_of(const Lanes* values, int count, const Lanes& active) {
  Lanes total{};
  for (int i = 0; i < count; ++i) total += values[i] * values[i];
  return sum(total * active);
}

Lanes active_lanes(int active) {
  Lanes result{};
  for (int lane = 0; lane < active; ++lane) result[lane] = 1;
  return result;
}

/// Adds values (nodes, components, lanes) to a load.
void scatter(const Lanes* values, int nodes, int components, const std::int32_t* dofs, int active, fem::Load& load) {
  for (int a = 0; a < nodes; ++a) {
    for (int lane = 0; lane < active; ++lane) {
      const std::int32_t dof = dofs[a * lane_count + lane];
      if (dof < 0) continue;
      double* target = load.at(dof);
      for (int k = 0; k < components; ++k) target[k] += values[a * components + k][lane];
    }
  }
}

}  // namespace

Assembly::Assembly(const Continuum& continuum, const FlowSettings& settings, const Conditions& conditions,
                   const Prescribed& prescribed, MeshFollower* motion)
    : continuum_(continuum),
      settings_(settings),
      conditions_(conditions),
      fields_(continuum, settings, conditions, prescribed, motion),
      stabilisation_(continuum),
      momentum_(continuum.velocity_space, continuum.mesh->dimension),
      mass_(continuum.pressure_space, 1),
      slope_(continuum.pressure_space, continuum.mesh->dimension),
      traction_(continuum.velocity_space, continuum.mesh->dimension),
      outer_forces_(static_cast<std::size_t>(continuum.velocity_space.dofs.num_owned) * continuum.mesh->dimension) {
  find_held_rows();
  sort_tractions();
  int count = 0;
  with_element(continuum_.velocity_space, [&count]<int D, int Degree>() { count = Element<D, Degree>::count; });
  matrix_ = std::make_unique<la::AssembledMatrix>(layout(), rows_of_cells(), count, held_rows_, true);
  cell_matrices_.resize(static_cast<std::size_t>(continuum.mesh->num_cells()) * count * count);
}

void Assembly::find_held_rows() {
  const int d = continuum_.mesh->dimension;
  for (const PrescribedComponent& entry : conditions_.components) {
    if (entry.dof < continuum_.velocity_space.dofs.num_owned) held_rows_.push_back(entry.dof * d + entry.component);
  }
  // Fluid between walls alone: the pressure is known up to a constant, its first unknown is set to 0.
  const base::IndexMap& pressures = continuum_.pressure_space.dofs;
  if (continuum_.has_fluid && !continuum_.has_solid && !conditions_.sets_pressure_level && pressures.offset == 0 &&
      pressures.num_owned > 0) {
    held_rows_.push_back(layout().start(1));
  }
}

void Assembly::sort_tractions() {
  const int boundaries = static_cast<int>(conditions_.boundaries.size());
  for (int boundary = 0; boundary < boundaries; ++boundary) {
    for (int facet = 0; facet <= continuum_.mesh->dimension; ++facet) {
      std::vector<std::int32_t> cells;
      for (const TractionFacet& traction : conditions_.tractions) {
        if (traction.boundary == boundary && traction.index == facet) cells.push_back(traction.cell);
      }
      if (cells.empty()) continue;
      tractions_.push_back(
          {boundary, facet,
           make_batches(cells, continuum_.cell_solid, continuum_.velocity_space, continuum_.pressure_space)});
    }
  }
}

/// Global rows of each cell's unknowns in the order of Element; -1 where a cell has no pressure.
std::vector<PetscInt> Assembly::rows_of_cells() const {
  const int d = continuum_.mesh->dimension;
  const bool is_linear = continuum_.velocity_space.degree == 1;
  std::vector<PetscInt> rows;
  for (std::int32_t cell = 0; cell < continuum_.mesh->num_cells(); ++cell) {
    const auto dofs = continuum_.pressure_space.dofs_of(cell);
    for (const std::int32_t dof : continuum_.velocity_space.dofs_of(cell)) {
      for (int k = 0; k < d; ++k) rows.push_back(layout().global(0, dof, k));
    }
    for (const std::int32_t dof : dofs) rows.push_back(dof < 0 ? -1 : layout().global(1, dof, 0));
    for (const std::int32_t dof : dofs) {
      for (int k = 0; k < d && is_linear; ++k) rows.push_back(dof < 0 ? -1 : layout().global(2, dof, k));
    }
  }
  return rows;
}

void Assembly::begin_step(const State& state, const Stage& stage, Start start, Vec unknowns) {
  fields_.begin_step(state, stage, start, unknowns);
  fields_.follow(unknowns);
  with_element(continuum_.velocity_space, [&]<int D, int Degree>() {
    if (!needs_stabilisation(continuum_, settings_)) return;
    const fem::Field gradient = stabilise<D, Degree>(fields_, continuum_, settings_, stabilisation_);
    if (!Element<D, Degree>::is_stabilised) return;
    const la::OwnedValues values(unknowns);
    layout().copy_owned_to_system(2, gradient.values, values.data());
  });
  if (start == Start::extrapolated) fields_.predict(unknowns);
}

ResidualSize Assembly::residual(Vec unknowns, Vec result) {
  fields_.follow(unknowns);
  fields_.find_forces();
  for (fem::Load* load : {&momentum_, &mass_, &slope_, &traction_})
    std::fill(load->values.begin(), load->values.end(), 0.0);
  ResidualSums sums(continuum_.labels());
  with_element(continuum_.velocity_space, [&]<int D, int Degree>() {
    sum_cells<D, Degree>(sums);
    sum_tractions<D, Degree>(sums);
  });
  sum_over_ranks(sums);
  const ResidualSize size = sums.total(continuum_.mesh->comm);
  const la::OwnedValues values(result);
  layout().copy_owned_to_system(0, momentum_.values, values.data());
  layout().copy_owned_to_system(1, mass_.values, values.data());
  if (continuum_.velocity_space.degree == 1) layout().copy_owned_to_system(2, slope_.values, values.data());
  for (const PetscInt row : held_rows_) values[row] = 0;
  return size;
}

template <int D, int Degree>
void Assembly::sum_cells(ResidualSums& sums) {
  using E = Element<D, Degree>;
  CellInput<D, Degree> in{};
  CellResidual<D, Degree> out{};
  const CellBatches& batches = continuum_.batches;
  smallest_cell_ = -1;
  for (std::size_t batch = 0; batch < batches.batches.size(); ++batch) {
    const auto& [solid, count, cells] = batches.batches[batch];
    fields_.gather(batches, batch, in);
    const CellStabilisation<D> stabilisation = stabilisation_.of_batch<D>(batches, batch);
    if (solid < 0) {
      fluid_residual<D, Degree>(in, stabilisation, settings_.viscosity, out);
    } else {
      solid_residual<D, Degree>(in, stabilisation, continuum_.elasticity[solid],
                                continuum_.solids[solid].incompressible, out);
    }
    for (int lane = 0; lane < lane_count; ++lane) {
      const double determinant = out.smallest_determinant[lane];
      if (!(determinant > 0)) sums.mark_inverted();
      if (smallest_cell_ >= 0 && !(determinant < smallest_determinant_)) continue;
      smallest_determinant_ = determinant;
      smallest_cell_ = cells[lane];
    }
    scatter(out.values, E::nodes, D, batches.velocity_dofs_of(batch), count, momentum_);
    scatter(out.values + E::pressure(0), E::corners, 1, batches.pressure_dofs_of(batch), count, mass_);
    const int label = 1 + solid, pressure_label = continuum_.pressure_label(solid);
    const Lanes active = active_lanes(count);
    sums.add_terms(
        ResidualSums::momentum, label,
        squares_of(out.values, E::nodes * D, active) + E::corners * squares_of(&out.momentum_size, 1, active));
    sums.add_terms(ResidualSums::mass, pressure_label, E::corners * squares_of(&out.mass_size, 1, active));
    if constexpr (E::is_stabilised) {
      scatter(out.values + E::gradient(0, 0), E::corners, D, batches.pressure_dofs_of(batch), count, slope_);
      sums.add_terms(ResidualSums::projection, pressure_label, E::corners * squares_of(&out.gradient_size, 1, active));
    }
  }
}

std::string Assembly::worst_cell() const {
  const mesh::Mesh& mesh = *continuum_.mesh;
  // Kind and middle, of the rank that has it.
  std::vector<double> mine;
  if (smallest_cell_ >= 0) {
    mine = {smallest_determinant_, static_cast<double>(continuum_.cell_solid[smallest_cell_]), 0, 0, 0};
    for (const std::int32_t v : mesh.vertices_of(smallest_cell_)) {
      for (int k = 0; k < mesh.dimension; ++k) mine[2 + k] += mesh.point(v)[k] / (mesh.dimension + 1);
    }
  }
  const std::vector<double> all = base::concatenate_all(mesh.comm, mine);
  std::size_t worst = 0;
  for (std::size_t i = 0; i < all.size(); i += 5) {
    if (!(all[i] > all[worst])) worst = i;
  }
  const int solid = static_cast<int>(all[worst + 1]);
  const std::string name = solid < 0                     ? "the fluid"
                           : solid == continuum_.contact ? "the contact medium"
                                                         : "'" + continuum_.solids[solid].region + "'";
  const std::string depth = mesh.dimension == 3 ? fmt::format(", {:.5g}", all[worst + 4]) : "";
  return fmt::format("of {} at rest at ({:.5g}, {:.5g}{}) m", name, all[worst + 2], all[worst + 3], depth);
}

template <int D, int Degree>
void Assembly::sum_tractions(ResidualSums& sums) {
  using E = Element<D, Degree>;
  CellInput<D, Degree> in{};
  CellResidual<D, Degree> out{};
  for (const auto& [index, facet, batches] : tractions_) {
    const Traction traction = traction_of(conditions_.boundaries[index], settings_, fields_.stage_time());
    for (std::size_t batch = 0; batch < batches.batches.size(); ++batch) {
      const auto& [solid, count, cells] = batches.batches[batch];
      fields_.gather(batches, batch, in);
      std::fill(out.values, out.values + E::count, Lanes{});
      add_traction<D, Degree>(in, facet, traction, out);
      scatter(out.values, E::nodes, D, batches.velocity_dofs_of(batch), count, traction_);
      sums.add_terms(ResidualSums::momentum, 1 + solid, squares_of(out.values, E::nodes * D, active_lanes(count)));
    }
  }
}

/// Makes the residual whole at its owners, where essential values leave none, and adds up its squares.
void Assembly::sum_over_ranks(ResidualSums& sums) {
  const int d = continuum_.mesh->dimension;
  for (std::size_t i = 0; i < momentum_.values.size(); ++i) momentum_.values[i] += traction_.values[i];
  momentum_.add_to_owners();
  if (conditions_.sets_pressure_level) traction_.add_to_owners();
  for (std::size_t i = 0; i < outer_forces_.size(); ++i) outer_forces_[i] = -traction_.values[i];
  mass_.add_to_owners();
  if (continuum_.velocity_space.degree == 1) slope_.add_to_owners();
  for (const PetscInt row : held_rows_) {
    if (row < layout().start(1)) {
      outer_forces_[row] += momentum_.values[row];
      momentum_.values[row] = 0;
    } else {
      mass_.values[row - layout().start(1)] = 0;
    }
  }
  for (std::int32_t dof = 0; dof < continuum_.velocity_space.dofs.num_owned; ++dof) {
    const int label = 1 + continuum_.dof_solid[dof];
    for (int k = 0; k < d; ++k) sums.add_entry(ResidualSums::momentum, label, momentum_.at(dof)[k]);
  }
  for (std::int32_t dof = 0; dof < continuum_.pressure_space.dofs.num_owned; ++dof) {
    const int label = continuum_.pressure_space.dof_label[dof];
    sums.add_entry(ResidualSums::mass, label, mass_.values[dof]);
    for (int k = 0; k < d; ++k) sums.add_entry(ResidualSums::projection, label, slope_.at(dof)[k]);
  }
}

void Assembly::jacobian() {
  with_element(continuum_.velocity_space, [&]<int D, int Degree>() { sum_jacobian<D, Degree>(); });
  matrix_->assemble(cell_matrices_);
}

template <int D, int Degree>
void Assembly::sum_jacobian() {
  constexpr std::size_t entries = Element<D, Degree>::count * Element<D, Degree>::count;
  const Stage& stage = fields_.stage();
  CellInput<D, Degree> in{};
  std::vector<Lanes> matrix(entries);
  const auto spread = [&](const CellBatches::Batch& batch, bool adds) {
    for (int lane = 0; lane < batch.active; ++lane) {
      double* target = cell_matrices_.data() + batch.cell[lane] * entries;
      for (std::size_t i = 0; i < entries; ++i) target[i] = matrix[i][lane] + (adds ? target[i] : 0.0);
    }
  };
  const CellBatches& batches = continuum_.batches;
  for (std::size_t batch = 0; batch < batches.batches.size(); ++batch) {
    const std::int32_t solid = batches.batches[batch].solid;
    fields_.gather(batches, batch, in);
    const CellStabilisation<D> stabilisation = stabilisation_.of_batch<D>(batches, batch);
    if (solid < 0) {
      fluid_jacobian<D, Degree>(in, stabilisation, settings_.viscosity, stage, matrix.data());
    } else {
      solid_jacobian<D, Degree>(in, stabilisation, continuum_.elasticity[solid],
                                continuum_.solids[solid].incompressible, stage, matrix.data());
    }
    spread(batches.batches[batch], false);
  }
  for (const auto& [index, facet, facets] : tractions_) {
    const Traction traction = traction_of(conditions_.boundaries[index], settings_, fields_.stage_time());
    if (traction.backflow_weight == 0 && traction.viscosity == 0) continue;
    for (std::size_t batch = 0; batch < facets.batches.size(); ++batch) {
      fields_.gather(facets, batch, in);
      std::fill(matrix.begin(), matrix.end(), Lanes{});
      add_traction_jacobian<D, Degree>(in, facet, traction, stage, matrix.data());
      spread(facets.batches[batch], true);
    }
  }
}

}  // namespace vocalis::fsi
