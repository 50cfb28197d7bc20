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
Matrix<D, Lanes> deformation(const CellInput<D, Degree>& in, const PointGeometry<D, Degree>& geometry) {
  Matrix<D, Lanes> f = gradient_of<D, Element<D, Degree>::nodes>(in.displacement, geometry.gradient);
  for (int i = 0; i < D; ++i) f[i][i] += 1.0;
  return f;
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
    const Matrix<D, Lanes> f = deformation<D, Degree>(in, geometry);
    with_law(*solid, in, [&](const auto& law) {
      result.elastic += weight * law.energy(f);
      result.dissipated += law.dissipation(weight, f, l);
    });
  }
  return result;
}

/// Kinetic and elastic. A point that would have turned over stores what it stores `before`.
template <int D, int Degree>
Lanes energy_of(const CellInput<D, Degree>& in, const Elasticity* solid, const CellInput<D, Degree>& before) {
  using E = Element<D, Degree>;
  Lanes result{};
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Lanes weight = point.weight * geometry.determinant;
    result += 0.5 * in.density * weight * square<D>(value_of<D, E::nodes>(in.velocity, point.value));
    if (!solid) continue;
    Matrix<D, Lanes> f = deformation<D, Degree>(in, geometry);
    const Matrix<D, Lanes> f_before = deformation<D, Degree>(before, geometry);
    const Lanes j = determinant<D>(f);
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) f[i][k] = j > 0 ? f[i][k] : f_before[i][k];
    }
    with_law(*solid, in, [&](const auto& law) { result += weight * law.energy(f); });
  }
  return result;
}

/// Adds to all that moves what it did in the last step, times `steps`.
template <int D, int Degree>
void go_on(const State& state, const CellBatches& batches, std::size_t batch, double steps, CellInput<D, Degree>& in) {
  const bool is_fluid = batches.batches[batch].solid < 0;
  const std::int32_t* dofs = batches.velocity_dofs_of(batch);
  for (int a = 0; a < CellInput<D, Degree>::nodes; ++a) {
    for (int lane = 0; lane < lane_count; ++lane) {
      const std::size_t first = static_cast<std::size_t>(dofs[a * lane_count + lane]) * D;
      for (int k = 0; k < D; ++k) {
        const std::size_t i = first + k;
        const double way = state.displacement.values[i] - state.displacement_before.values[i];
        in.velocity[a][k][lane] += steps * (state.velocity.values[i] - state.velocity_before.values[i]);
        (is_fluid ? in.position : in.displacement)[a][k][lane] += steps * way;
      }
    }
  }
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
  const Stage& stage = fields.stage();
  total.kept.share = stage.ahead;
  CellInput<D, Degree> in{};
  for (std::size_t batch = 0; batch < continuum.batches.batches.size(); ++batch) {
    const auto& [solid, active, cells] = continuum.batches.batches[batch];
    fields.gather(continuum.batches, batch, in);
    const Elasticity* law = solid < 0 ? nullptr : &continuum.elasticity[solid];
    const BatchEnergy part = cell_energy<D, Degree>(in, solver.settings().viscosity, law, solver.settings().gravity);
    const auto energy_after = [&, active = active](double steps) {  // the stage's
      CellInput<D, Degree> other = in;
      go_on<D, Degree>(solver.state(), continuum.batches, batch, steps, other);
      return sum_active(energy_of<D, Degree>(other, law, in), active);
    };
    const double to_end = 1 - stage.weight, now = energy_after(to_end);
    total.kept.now += now;
    if (stage.ahead > 0) {
      const double next = energy_after(to_end + 1) - now, last = energy_after(to_end - 1) - now;
      total.kept.slope += 0.5 * (next - last);
      total.kept.curve += 0.5 * (next + last);
    }
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
  double* values[] = {&total.kinetic,  &total.elastic,    &total.supplied,  &total.dissipated,
                      &total.kept.now, &total.kept.slope, &total.kept.curve};
  for (double* value : values) {
    MPI_Allreduce(MPI_IN_PLACE, value, 1, MPI_DOUBLE, MPI_SUM, solver.continuum().mesh->comm);
  }
  return total;
}

}  // namespace vocalis::fsi
