#include "fsi_solver/measures/energy.hpp"

#include <mpi.h>

#include "core/mesh/facets.hpp"
#include "fsi_solver/cells/solid_law.hpp"
#include "fsi_solver/cells/tractions.hpp"
#include "fsi_solver/solution/assembly.hpp"

namespace vocalis::fsi {

namespace {

/// As EnergyRates, of a batch of cells; `supplied` by gravity.
struct BatchEnergy {
  Lanes kinetic{}, elastic{}, supplied{}, dissipated{};
};

template <int D>
Lanes square(const std::array<Lanes, D>& v) {
  Lanes sum{};
  for (int k = 0; k < D; ++k) sum += v[k] * v[k];
  return sum;
}

template <int D, int Degree>
BatchEnergy cell_energy(const CellInput<D, Degree>& in, double viscosity, const Elasticity* solid,
                        const std::array<double, 3>& gravity) {
  using E = Element<D, Degree>;
  BatchEnergy result;
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Lanes weight = point.weight * geometry.determinant;
    const auto velocity = value_of<D, E::nodes>(in.velocity, point.value);
    const Matrix<D, Lanes> l = gradient_of<D, E::nodes>(in.velocity, geometry.gradient);
    result.kinetic += 0.5 * in.density * weight * square<D>(velocity);
    for (int k = 0; k < D; ++k) result.supplied += in.density * gravity[k] * weight * velocity[k];
    if (!solid) {
      result.dissipated += viscosity * weight * (contraction<D>(l, l) + contraction<D>(l, transposed<D>(l)));
      continue;
    }
    Matrix<D, Lanes> f = gradient_of<D, E::nodes>(in.displacement, geometry.gradient);
    for (int i = 0; i < D; ++i) f[i][i] += 1.0;
    with_law(*solid, in, [&](const auto& law) {
      result.elastic += weight * law.energy(f);
      result.dissipated += law.dissipation(weight, f, l);
    });
  }
  return result;
}

/// Kinetic energy that flows in through the facets opposite to a corner [W].
template <int D, int Degree>
Lanes inflow(const CellInput<D, Degree>& in, int facet) {
  using E = Element<D, Degree>;
  Lanes result{};
  for (const typename E::Point& point : E::facet_points(facet)) {
    const auto area = area_at<D, Degree>(point, geometry_at<D, Degree>(point, in.position), facet);
    const auto velocity = value_of<D, E::nodes>(in.velocity, point.value);
    const auto slip = value_of<D, E::nodes>(in.slip, point.value);
    for (int k = 0; k < D; ++k) result -= 0.5 * in.density * square<D>(velocity) * slip[k] * area[k];
  }
  return result;
}

double sum_active(const Lanes& values, int active) {
  double result = 0;
  for (int lane = 0; lane < active; ++lane) result += values[lane];
  return result;
}

template <int D, int Degree>
EnergyRates sum_energy(const FsiSolver& solver, const OpenFacets& open) {
  const Continuum& continuum = solver.continuum();
  const StageFields& fields = solver.assembly().fields();
  EnergyRates total;
  CellInput<D, Degree> in{};
  for (std::size_t batch = 0; batch < continuum.batches.batches.size(); ++batch) {
    const auto& [solid, active, cells] = continuum.batches.batches[batch];
    fields.gather(continuum.batches, batch, in);
    const BatchEnergy part = cell_energy<D, Degree>(
        in, solver.settings().viscosity, solid < 0 ? nullptr : &continuum.elasticity[solid], solver.settings().gravity);
    total.kinetic += sum_active(part.kinetic, active);
    total.elastic += sum_active(part.elastic, active);
    total.supplied += sum_active(part.supplied, active);
    total.dissipated += sum_active(part.dissipated, active);
  }
  for (std::size_t facet = 0; facet < open.size(); ++facet) {
    for (std::size_t batch = 0; batch < open[facet].batches.size(); ++batch) {
      fields.gather(open[facet], batch, in);
      total.supplied += sum_active(inflow<D, Degree>(in, static_cast<int>(facet)), open[facet].batches[batch].active);
    }
  }
  return total;
}

}  // namespace

OpenFacets find_open_facets(const FsiSolver& solver) {
  const Continuum& continuum = solver.continuum();
  const mesh::Mesh& mesh = *continuum.mesh;
  std::vector<std::vector<std::int32_t>> cells(mesh.dimension + 1);
  for (const FlowBoundary& boundary : solver.settings().boundaries) {
    using Kind = FlowBoundaryKind;
    if (boundary.kind == Kind::wall || boundary.kind == Kind::symmetry || boundary.kind == Kind::fixed) continue;
    for (const mesh::NamedFacet& facet : mesh::facets_of_group(mesh, boundary.group)) {
      if (continuum.cell_solid[facet.cell] < 0) cells[facet.index].push_back(facet.cell);
    }
  }
  OpenFacets result;
  for (const std::vector<std::int32_t>& list : cells) {
    result.push_back(make_batches(list, continuum.cell_solid, continuum.velocity_space, continuum.pressure_space));
  }
  return result;
}

EnergyRates energy(const FsiSolver& solver, const OpenFacets& open) {
  EnergyRates total;
  with_element(solver.continuum().velocity_space,
               [&]<int D, int Degree>() { total = sum_energy<D, Degree>(solver, open); });
  const Assembly& assembly = solver.assembly();
  const std::vector<double>& velocity = assembly.fields().stage_velocity();
  for (std::size_t i = 0; i < assembly.outer_forces().size(); ++i) {
    total.supplied += assembly.outer_forces()[i] * velocity[i];
  }
  double* values[] = {&total.kinetic, &total.elastic, &total.supplied, &total.dissipated};
  for (double* value : values) {
    MPI_Allreduce(MPI_IN_PLACE, value, 1, MPI_DOUBLE, MPI_SUM, solver.continuum().mesh->comm);
  }
  return total;
}

}  // namespace vocalis::fsi
