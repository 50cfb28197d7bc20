#include "fsi_solver/measures/body.hpp"

#include "core/base/case_table.hpp"
#include "core/base/error.hpp"
#include "core/base/mpi.hpp"
#include "fsi_solver/cells/fluid_terms.hpp"
#include "fsi_solver/solution/assembly.hpp"

namespace vocalis::fsi {

namespace {

template <int D, int Degree>
std::array<double, 3> sum_forces(const FsiSolver& solver, const Body& body) {
  using E = Element<D, Degree>;
  const Assembly& assembly = solver.assembly();
  CellInput<D, Degree> in{};
  CellResidual<D, Degree> out{};
  std::array<double, 3> force = {0, 0, 0};
  for (std::size_t batch = 0; batch < body.cells.batches.size(); ++batch) {
    assembly.fields().gather(body.cells, batch, in);
    fluid_residual<D, Degree>(in, assembly.stabilisation().of_batch<D>(body.cells, batch), solver.settings().viscosity,
                              out);
    const std::int32_t* dofs = body.cells.velocity_dofs_of(batch);
    for (int a = 0; a < E::nodes; ++a) {
      for (int lane = 0; lane < body.cells.batches[batch].active; ++lane) {
        if (!body.is_on_it[dofs[a * lane_count + lane]]) continue;
        for (int k = 0; k < D; ++k) force[k] -= out.values[E::velocity(a, k)][lane];
      }
    }
  }
  return force;
}

}  // namespace

Body make_body(const FsiSolver& solver, const std::vector<std::string>& groups) {
  const Continuum& continuum = solver.continuum();
  const mesh::Mesh& mesh = *continuum.mesh;
  std::vector<mesh::NamedFacet> facets;
  for (const std::string& group : groups) {
    if (mesh::index_of(mesh.group_names, group) < 0) {
      throw base::UserError("a force needs groups of facets of the mesh", group,
                            base::did_you_mean(group, mesh.group_names));
    }
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, group)) {
      if (continuum.cell_solid[facet.cell] < 0) facets.push_back(facet);
    }
  }
  if (base::sum(mesh.comm, static_cast<std::int64_t>(facets.size())) == 0) {
    throw base::UserError("a force needs groups of facets that the fluid touches", groups.empty() ? "" : groups.front(),
                          "name walls of the fluid, or interfaces");
  }
  Body body;
  body.is_on_it = mark_dofs(continuum.velocity_space, facets);
  std::vector<std::int32_t> cells;
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (continuum.cell_solid[cell] >= 0) continue;
    for (const std::int32_t dof : continuum.velocity_space.dofs_of(cell)) {
      if (!body.is_on_it[dof]) continue;
      cells.push_back(cell);
      break;
    }
  }
  body.cells = make_batches(cells, continuum.cell_solid, continuum.velocity_space, continuum.pressure_space);
  return body;
}

std::array<double, 3> force_on(const FsiSolver& solver, const Body& body) {
  std::array<double, 3> force = {0, 0, 0};
  with_element(solver.continuum().velocity_space,
               [&]<int D, int Degree>() { force = sum_forces<D, Degree>(solver, body); });
  MPI_Allreduce(MPI_IN_PLACE, force.data(), 3, MPI_DOUBLE, MPI_SUM, solver.continuum().mesh->comm);
  return force;
}

}  // namespace vocalis::fsi
