#include "tests/verification/acoustic_fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/mpi.hpp"
#include "core/fem/simplex.hpp"
#include "core/mesh/generate.hpp"

namespace vocalis::acoustic::verification {

namespace {

double measure_of(const mesh::Mesh& mesh, std::span<const double> coordinates, std::int32_t cell) {
  const auto vertices = mesh.vertices_of(cell);
  const auto corner = [&](int i) {
    return coordinates.data() + static_cast<std::size_t>(vertices[i]) * mesh.dimension;
  };
  if (mesh.dimension == 2) return fem::simplex_geometry<2>({corner(0), corner(1), corner(2)}).measure;
  return fem::simplex_geometry<3>({corner(0), corner(1), corner(2), corner(3)}).measure;
}

}  // namespace

AcousticSettings unit_medium(double step, Integrator integrator) {
  AcousticSettings settings;
  settings.density = 1;
  settings.speed_of_sound = 1;
  settings.step = step;
  settings.integrator = integrator;
  return settings;
}

const char* name(Integrator integrator) { return integrator == Integrator::implicit ? "implicit" : "explicit"; }

mesh::Mesh box_mesh(std::array<double, 3> size, std::array<int, 3> cells) {
  return mesh::distribute(MPI_COMM_WORLD, mesh::box(MPI_COMM_WORLD, size, cells));
}

State state_of(const mesh::Mesh& mesh, const SpaceTime& pressure, const SpaceTime& potential, double time) {
  State state;
  state.time = time;
  for (std::int32_t v = 0; v < mesh.num_vertices(); ++v) {
    const std::span<const double> point(mesh.point(v), mesh.dimension);
    state.p.push_back(pressure(point, time));
    state.psi.push_back(potential(point, time));
  }
  return state;
}

fem::Load load_of(const fem::Space& space, std::span<const double> coordinates, const SpaceTime& f, double time) {
  const mesh::Mesh& mesh = *space.mesh;
  const int d = mesh.dimension;
  const fem::QuadratureRule& rule = fem::quadrature(d, 2);
  fem::Load load(space, 1);
  std::vector<double> point(d);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    const auto corner = [&](int i) { return coordinates.data() + static_cast<std::size_t>(vertices[i]) * d; };
    const double measure = measure_of(mesh, coordinates, cell);
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      std::fill(point.begin(), point.end(), 0.0);
      for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) point[k] += rule.points[q][i] * corner(i)[k];
      }
      const double weighed = measure * rule.weights[q] * f(point, time);
      for (int i = 0; i <= d; ++i) load.values[vertices[i]] += weighed * rule.points[q][i];
    }
  }
  load.add_to_owners();
  return load;
}

double relative_error(const AcousticSolver& solver, const SpaceTime& exact) {
  const mesh::Mesh& mesh = *solver.space().mesh;
  const std::vector<double>& pressure = solver.state().p;
  const int d = mesh.dimension;
  const fem::QuadratureRule& rule = fem::quadrature(d, 4);
  double difference = 0, whole = 0;
  std::vector<double> point(d);
  for (std::int32_t cell = 0; cell < mesh.num_cells(); ++cell) {
    const auto vertices = mesh.vertices_of(cell);
    const double measure = measure_of(mesh, mesh.coordinates, cell);
    for (std::size_t q = 0; q < rule.weights.size(); ++q) {
      std::fill(point.begin(), point.end(), 0.0);
      double found = 0;
      for (int i = 0; i <= d; ++i) {
        for (int k = 0; k < d; ++k) point[k] += rule.points[q][i] * mesh.point(vertices[i])[k];
        found += rule.points[q][i] * pressure[vertices[i]];
      }
      const double wanted = exact(point, solver.state().time);
      difference += measure * rule.weights[q] * (found - wanted) * (found - wanted);
      whole += measure * rule.weights[q] * wanted * wanted;
    }
  }
  return std::sqrt(base::sum(mesh.comm, difference) / base::sum(mesh.comm, whole));
}

double lowest_order(const std::vector<double>& errors) {
  double lowest = 100;
  for (std::size_t i = 1; i < errors.size(); ++i) lowest = std::min(lowest, std::log2(errors[i - 1] / errors[i]));
  return lowest;
}

void print_errors(const char* title, const std::vector<double>& errors, bool with_order) {
  if (base::rank(MPI_COMM_WORLD) != 0) return;
  fmt::print("  {:58} ", title);
  for (const double error : errors) fmt::print(" {:.2e}", error);
  fmt::print("{}\n",
             with_order ? fmt::format("  order {:.2f}", std::log2(errors[errors.size() - 2] / errors.back())) : "");
}

}  // namespace vocalis::acoustic::verification
