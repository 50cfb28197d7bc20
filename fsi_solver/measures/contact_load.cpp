#include "fsi_solver/measures/contact_load.hpp"

#include <algorithm>
#include <limits>

#include "core/base/mpi.hpp"
#include "core/mesh/facets.hpp"
#include "fsi_solver/cells/solid_law.hpp"
#include "fsi_solver/solution/assembly.hpp"

namespace vocalis::fsi {

namespace {

template <int D>
std::array<Lanes, D> times(const Matrix<D, Lanes>& a, const std::array<Lanes, D>& x) {
  std::array<Lanes, D> result{};
  for (int i = 0; i < D; ++i) {
    for (int j = 0; j < D; ++j) result[i] += a[i][j] * x[j];
  }
  return result;
}

template <int D>
Lanes dot(const std::array<Lanes, D>& a, const std::array<Lanes, D>& b) {
  Lanes sum{};
  for (int i = 0; i < D; ++i) sum += a[i] * b[i];
  return sum;
}

/// Mean of n·σ·n. With m = J F⁻ᵀN: J n·σ·n = m·P Fᵀm / |m|², and Fᵀm = J N.
template <int D, int Degree>
Lanes normal_stress(const CellInput<D, Degree>& in, const Elasticity& medium, const std::array<Lanes, D>& normal) {
  using E = Element<D, Degree>;
  Lanes sum{}, measure{};
  for (const typename E::Point& point : E::points()) {
    const auto geometry = geometry_at<D, Degree>(point, in.position);
    const Lanes weight = point.weight * geometry.determinant;
    Matrix<D, Lanes> f = gradient_of<D, E::nodes>(in.displacement, geometry.gradient);
    for (int i = 0; i < D; ++i) f[i][i] += 1.0;
    const Matrix<D, Lanes> rate = gradient_of<D, E::nodes>(in.velocity, geometry.gradient);
    Lanes pressure{};
    for (int b = 0; b <= D; ++b) pressure += in.pressure[b] * point.corner[b];
    const Matrix<D, Lanes> cof = cofactor<D>(f);
    const std::array<Lanes, D> m = times<D>(cof, normal);
    const Matrix<D, Lanes> p = with_law(medium, in, [&](const auto& law) { return law.stress(f, rate, pressure); });
    sum += weight * dot<D>(m, times<D>(p, normal)) / dot<D>(m, m);
    measure += weight;
  }
  return sum / measure;
}

template <int D, int Degree>
void fill(const FsiSolver& solver, std::span<const double> normal, ContactLoad& load) {
  const Continuum& continuum = solver.continuum();
  CellInput<D, Degree> in{};
  for (std::size_t batch = 0; batch < continuum.batches.batches.size(); ++batch) {
    const auto& [solid, active, cells] = continuum.batches.batches[batch];
    if (solid < 0 || solid != continuum.contact) continue;
    solver.assembly().fields().gather(continuum.batches, batch, in);
    std::array<Lanes, D> normals;
    for (int k = 0; k < D; ++k) {
      Lanes component{};
      for (int lane = 0; lane < lane_count; ++lane) {
        component[lane] = normal[static_cast<std::size_t>(cells[lane]) * D + k];
      }
      normals[k] = component;
    }
    const Lanes found = normal_stress<D, Degree>(in, continuum.elasticity[solid], normals);
    for (int lane = 0; lane < active; ++lane) {
      load.normal_stress[cells[lane]] = found[lane];
    }
  }
}

/// Pressure of the fluid at contact cells: at those vertices of the fluid cells around that no contact cell has, for at
/// the others it is the contact's own.
void find_fluid_pressure(const FsiSolver& solver, ContactLoad& load) {
  const Continuum& continuum = solver.continuum();
  const mesh::Mesh& mesh = *continuum.mesh;
  std::vector<std::int32_t> is_contact(mesh.num_cells());
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    is_contact[cell] = continuum.cell_solid[cell] >= 0 && continuum.cell_solid[cell] == continuum.contact;
  }
  const std::vector<std::int32_t> touches = mesh::mark_vertices_of_cells(mesh, is_contact);
  const fem::Field& pressure = solver.assembly().fields().pressure();
  constexpr double none = std::numeric_limits<double>::infinity();
  double lowest = none;
  fem::Load sums(continuum.vertex_space, 2);  // of pressures and their number, at vertices of contact cells
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    if (continuum.cell_solid[cell] >= 0) continue;
    const auto vertices = mesh.vertices_of(cell);
    const auto dofs = continuum.pressure_space.dofs_of(cell);
    for (const std::int32_t at : vertices) {
      for (std::size_t i = 0; touches[at] && i < vertices.size(); ++i) {
        if (touches[vertices[i]]) continue;
        sums.values[2 * static_cast<std::size_t>(at)] += pressure.values[dofs[i]];
        sums.values[2 * static_cast<std::size_t>(at) + 1] += 1;
        lowest = std::min(lowest, pressure.values[dofs[i]]);
      }
    }
  }
  sums.add_to_owners();
  continuum.vertex_space.halo.copy_to_ghosts(sums.values, 2);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    double total = 0, count = 0;
    for (const std::int32_t v : mesh.vertices_of(cell)) {
      total += sums.values[2 * static_cast<std::size_t>(v)];
      count += sums.values[2 * static_cast<std::size_t>(v) + 1];
    }
    if (is_contact[cell] && count > 0) load.fluid_pressure[cell] = total / count;
  }
  lowest = base::smallest(mesh.comm, lowest);
  load.lowest_fluid_pressure = lowest < none ? lowest : 0;
}

}  // namespace

ContactLoad contact_load(const FsiSolver& solver, std::span<const double> normal) {
  const Continuum& continuum = solver.continuum();
  ContactLoad load;
  load.normal_stress.assign(continuum.mesh->num_cells(), 0.0);
  if (!continuum.batches.batches.empty() && continuum.contact >= 0) {
    with_element(continuum.velocity_space, [&]<int D, int Degree>() { fill<D, Degree>(solver, normal, load); });
  }
  load.fluid_pressure.assign(continuum.mesh->num_cells(), std::numeric_limits<double>::quiet_NaN());
  find_fluid_pressure(solver, load);
  return load;
}

}  // namespace vocalis::fsi
